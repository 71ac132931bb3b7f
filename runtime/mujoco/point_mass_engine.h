// MuJoCo as the engine of a point mass: one body on three slide joints.
// Tested by tests/runtime/point_mass_test.cpp.
#pragma once

#include <memory>
#include <string>

#include "runtime/engine/engine.h"

namespace twincraft {

/// @param mjcf  the very bytes the compiler emitted for `model`, whose plan is a translation
/// @throws NumericalFailure when MuJoCo does not load them
std::unique_ptr<Engine> make_mujoco_point_mass_engine(const Model& model, const std::string& mjcf);

}  // namespace twincraft
