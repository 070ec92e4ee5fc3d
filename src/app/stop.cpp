#include "welkin/app/stop.h"

#include <csignal>

namespace welkin::app {
namespace {

volatile std::sig_atomic_t g_stop = 0;

void onSignal(int signal) {
  g_stop = 1;
  std::signal(signal, SIG_DFL);  // the second one is final
}

}  // namespace

void listenForStop() {
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
  std::signal(SIGPIPE, SIG_IGN);  // a reader that goes away is an error of writing, not the end of the program
}

bool stopRequested() { return g_stop != 0; }

}  // namespace welkin::app
