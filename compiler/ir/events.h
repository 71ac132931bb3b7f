// When something changes from outside during a run.
#pragma once

#include <vector>

#include "compiler/ir/model.h"

namespace twincraft {

/// The times [s] inside the run at which an input changes: efforts, motor torques, loads and
/// thrusters. Ascending, without repeats.
std::vector<double> input_events(const Model& model);

}  // namespace twincraft
