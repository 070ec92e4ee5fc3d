#pragma once
// Independent pieces of work over a few threads.
#include <functional>

namespace welkin::reference {

// Calls work(i) once for each i in [0, count), from up to `threads` threads (0: one a core); returns when all are done. What the calls
// write must not depend on their order. `done` (optional) is called with the number finished, from one thread at a time.
void forEach(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& work,
             const std::function<void(std::size_t)>& done = {});

}  // namespace welkin::reference
