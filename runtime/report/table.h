// The report for people: vehicle, agreement, references, conservation, cost, verdict.
// Tested by tests/runtime/report_test.cpp.
#pragma once

#include <string>

#include "runtime/study/results.h"

namespace twincraft {

/// What is run, and how: one line and an empty one.
std::string heading(const Model& model);

/// The metrics with their tolerances; empty without a comparison.
std::string agreement_block(const ReportedMember& member, bool colour);

/// @param colour  mark passes and failures with terminal colours
std::string report_table(const ReportedMember& member, bool colour);

}  // namespace twincraft
