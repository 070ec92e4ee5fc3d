#pragma once
#include <string>

#include "welkin/render/debug_view.h"

namespace welkin::measure {

// As a report and the window's state have it, with all that a legend needs: topic, scale with colours, kinds.
std::string debugJson(const DebugNumbers& numbers);

}  // namespace welkin::measure
