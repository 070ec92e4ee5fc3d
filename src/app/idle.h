#pragma once
// For timing on software GL, where the clock is that of the whole process.

namespace welkin::app {

// Waits until no thread of this process works, so that the CPU clock of the next frame sees that frame alone. The worker's answer to a
// frame is then there before the next one asks for it. Gives up after 10 s.
void waitUntilIdle();

}  // namespace welkin::app
