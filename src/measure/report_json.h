#pragma once
// Parts of JSON that all reports share.
#include <nlohmann/json.hpp>

#include "welkin/measure/timings.h"

namespace welkin::measure {

nlohmann::ordered_json contextJson(const ReportContext& context);

}  // namespace welkin::measure
