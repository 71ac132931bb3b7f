// The body tree as MJCF that MuJoCo 2.2 and 3.x both read. Knows no component: it prints bodies,
// joints, motors and what `simulate` needs to start from the spec's initial state.
// Tested by tests/runtime/mjcf_test.cpp.
#pragma once

#include <string>

#include "compiler/ir/model.h"

namespace twincraft {

/// A pure function of the model: the same bytes for the same model, numbers by shortest round trip.
/// @pre every number of the model is finite, and every inertia physical within rounding
std::string emit_mjcf(const Model& model);

}  // namespace twincraft
