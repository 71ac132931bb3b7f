// A trajectory as comma-separated values: the same columns for either engine, so that two files can
// be compared line by line.  Tested by tests/runtime/report_test.cpp.
#pragma once

#include <string>

#include "compiler/ir/model.h"
#include "runtime/study/propagate.h"

namespace twincraft {

/// A header `name [unit]` and one line per sample; doubles read back exactly.
/// Names of coordinates begin with a letter (the compiler saw to it), so no cell is a formula.
std::string trajectory_csv(const Model& model, const Trajectory& trajectory);

}  // namespace twincraft
