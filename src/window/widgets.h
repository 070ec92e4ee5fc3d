#pragma once
// Fields of the panels: value and unit, range, an explanation under the mouse, and a double click back to where the value was loaded.
#include <imgui.h>

#include <array>
#include <map>
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
bool radio(const char* label, bool on, const char* explanation);  // true: it was chosen
bool press(const char* label, const char* explanation);            // a button
std::string takeFinishedEdit();                                    // label of the field that was let go since the last call; empty: none
void markEdit(const char* label);                                  // by a button
const std::map<std::string, std::array<float, 4>>& fieldPlaces();  // of fields in the last frame: x0, y0, x1, y1; for tests
void remember(const char* label);                                  // place of the item before
void beginFields();                                                // of a frame
void explain(const char* text);                                    // of the item before, under the mouse
void line(const std::string& name, const std::string& value);

}  // namespace welkin::window
