// A study for people: one row per member, then what the members show together.
// Tested by tests/runtime/sweep_test.cpp.
#pragma once

#include <string>

#include "runtime/study/results.h"

namespace twincraft {

/// @param colour  mark passes and failures with terminal colours
std::string study_table(const Report& report, bool colour);

/// One line for a member that has just ended: `3 of 38  rk4, step 0.1  attitude 2.8e-03 deg agree`.
std::string member_line(std::size_t index, const ReportedMember& member, const StudyPlan& plan);

}  // namespace twincraft
