#pragma once
// Fields of the panels: value and unit, range, an explanation under the mouse, and a double click back to where the value was loaded.
#include <imgui.h>

#include <span>
#include <string>

namespace welkin::window {

struct Range {
  double low, high;
  const char* format = "%.3g";  // with the unit
  bool logarithmic = false;
};

struct Edited {
  bool now = false;       // the value has changed
  bool finished = false;  // and the hand has let go
};

Edited number(const char* label, double& value, double loaded, const Range& range, const char* explanation);
bool choice(const char* label, int& index, std::span<const char* const> names, const char* explanation);
bool tick(const char* label, bool& value, const char* explanation);
void explain(const char* text);  // of the item before, under the mouse
void line(const std::string& name, const std::string& value);

}  // namespace welkin::window
