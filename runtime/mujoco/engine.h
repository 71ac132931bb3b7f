// MuJoCo as a forward-dynamics engine: the minimal pipeline on the emitted MJCF, evaluated in the
// hub's co-moving frame. Tested by tests/runtime/mujoco_test.cpp and the component battery.
#pragma once

#include <memory>
#include <string>

#include "runtime/engine/engine.h"

namespace twincraft {

/// @param mjcf  the very bytes the compiler emitted for `model`
/// @throws NumericalFailure when MuJoCo does not load them
std::unique_ptr<Engine> make_mujoco_engine(const Model& model, const std::string& mjcf);

}  // namespace twincraft
