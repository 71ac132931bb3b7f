// The report for people: vehicle, agreement, references, conservation, cost, verdict.
// Tested by tests/runtime/report_test.cpp.
#pragma once

#include <string>

#include "runtime/report/report.h"

namespace twincraft {

/// @param colour  mark passes and failures with terminal colours
std::string report_table(const ReportedMember& member, bool colour);

}  // namespace twincraft
