// Wheels whose tensors have no axes. A balanced wheel's tensor is Js 1 + (Jt - Js)(1 - a a^T), and
// the second part does not see the spin: mount or wheel may carry it. With the wheel, MuJoCo
// multiplies a tensor in turned axes by the wheel's rate, and what rounding leaves of Omega x I
// Omega is a torque of epsilon Js Omega^2 that points the same way for the whole run. With the
// mount, the wheel has Js 1, which is exact in any axes. The emitted MJCF keeps the wheel's own
// tensor. Tested by tests/runtime/mujoco_test.cpp.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "compiler/ir/body_tree.h"

namespace twincraft {

/// Moves the second part to the mounts of those wheels that are not exact as they are: a wheel on
/// the hub along one of its axes is, because the hub's axes are the world's in an evaluation.
/// @return the wheels' bodies in `loaded`, which has the exact masses of `tree`
std::vector<int> make_wheels_round(const BodyTree& tree, mjModel& loaded);

/// The axes of their inertials: those of the world. @pre mj_kinematics has run, mj_comPos has not
void align_round_wheels(const std::vector<int>& bodies, mjData& data);

}  // namespace twincraft
