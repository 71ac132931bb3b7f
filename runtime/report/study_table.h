// A study for people: one row per member, then what the members show together.
// Tested by tests/runtime/sweep_test.cpp.
#pragma once

#include <string>

#include "runtime/report/report.h"

namespace twincraft {

/// @param colour  mark passes and failures with terminal colours
std::string study_table(const Report& report, bool colour);

}  // namespace twincraft
