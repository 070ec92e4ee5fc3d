#pragma once
// How the interface looks: a night's blue, a sunlit accent, letters of the system if it has them.
namespace welkin::window {

void useTheme(double scale);  // of the monitor

}  // namespace welkin::window
