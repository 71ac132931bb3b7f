// The report for people: vehicle, agreement, references, conservation, cost, verdict.
// Tested by tests/runtime/report_test.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "runtime/report/words.h"
#include "runtime/study/results.h"

namespace twincraft {

/// What is run, and how: one line and an empty one.
std::string heading(const Model& model);

/// A quantity that was compared, and what people call it.
struct DifferenceRow {
  Metric metric;
  MetricWords words;
};
/// Maximum, when it occurred, and tolerance of each. @param holds  what held its tolerance is ok
std::string difference_block(std::string_view heading, std::span<const DifferenceRow> rows,
                             bool holds, bool colour);

/// The metrics with their tolerances; empty without a comparison.
std::string agreement_block(const ReportedMember& member, bool colour);

/// @param colour  mark passes and failures with terminal colours
std::string report_table(const ReportedMember& member, bool colour);

}  // namespace twincraft
