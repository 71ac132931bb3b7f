// report.json: the whole result for programs, format `twincraft-report/1`.
// Tested by tests/runtime/report_test.cpp.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/study/results.h"

namespace twincraft {

/// Which program and machine made a report, as all kinds of report.json have it.
nlohmann::ordered_json provenance_json(const Provenance& provenance);

/// What the file holds of `report.members`, for printers that show it otherwise.
nlohmann::ordered_json report_value(const Report& report);

/// A member as it stands in the file, with what separates it from the one before.
std::string report_member(const ReportedMember& member, bool is_first);

/// The file before its first member and after its last.
struct ReportFrame {
  std::string before, after;
};
ReportFrame report_frame(const Report& report);

/// Metrics that do not apply are absent; numbers that are not finite are null.
std::string report_json(const Report& report);

}  // namespace twincraft
