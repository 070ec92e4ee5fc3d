#pragma once
// Ctrl-C and termination: long commands end at the next frame and leave only whole files. A second Ctrl-C ends at once.

namespace welkin::app {

void listenForStop();
bool stopRequested();

}  // namespace welkin::app
