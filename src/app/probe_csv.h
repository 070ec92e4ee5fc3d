#pragma once
// Tables of rays for `welkin probe`: comma-separated, the first line names the columns.
#include <filesystem>
#include <string>
#include <vector>

#include "welkin/core/result.h"
#include "welkin/physics/probe.h"

namespace welkin::app {

struct ProbeTable {
  std::string header;  // as it was read, and so are the rows
  std::vector<std::string> rows;
  std::vector<ProbeRay> rays;  // one a row
};

// Columns by name, in any order: altitude_m, sun_zenith_deg, view_zenith_deg, relative_azimuth_deg; also max_distance_m (empty: no limit)
// and, both or none, latitude_deg and longitude_deg. Empty lines are skipped. The error names file, line, column and what was expected.
Result<ProbeTable> parseProbeTable(const std::string& text, const std::string& sourceName);
Result<ProbeTable> readProbeTable(const std::filesystem::path& file);

// The rows as they were read, each with its results behind it in nine significant digits; one result a row.
std::string probeResultText(const ProbeTable& table, const std::vector<ProbeResult>& results, bool withErrors);

}  // namespace welkin::app
