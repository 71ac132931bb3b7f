// Verdicts in words, for the terminal: of a member and of a run.
#pragma once

#include <string>

#include "runtime/study/results.h"

namespace twincraft {

/// One line, without its end: `the engines agree`, `unresolved: w.1 swings at ...`.
std::string verdict_line(const Member& member, bool colour);

/// The same of a whole study, with how many members it is about.
std::string verdict_line(const Report& report, bool colour);

/// What stands in a table: `agree`, `DISAGREE`, `unresolved`, `MuJoCo failed`.
std::string verdict_cell(const Member& member);

}  // namespace twincraft
