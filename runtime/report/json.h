// report.json: the whole result for programs, format `twincraft-report/1`.
// Tested by tests/runtime/report_test.cpp.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/report/report.h"

namespace twincraft {

/// What the file holds, for printers that show it otherwise.
nlohmann::ordered_json report_value(const Report& report);

/// Metrics that do not apply are absent; numbers that are not finite are null.
std::string report_json(const Report& report);

}  // namespace twincraft
