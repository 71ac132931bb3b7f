// How large the terms are of which MuJoCo forms mass matrix and bias forces. It refers every
// inertia and every motion to the centre of mass C of the whole tree, so a joint far from C sums m
// r^2 of what it carries where its own inertia is m d^2, d being the distance from the joint:
// rounding is of the former. The same holds for m r^2 Omega^2 of what turns. Tested by
// tests/runtime/proof_test.cpp.
#pragma once

#include <mujoco/mujoco.h>

#include "runtime/engine/held.h"

namespace twincraft {

/// In MuJoCo's order of degrees of freedom.
/// @pre mj_kinematics, mj_comPos and mj_comVel have run with the hub's origin at rest at zero, and
/// qfrc_passive is of this state
RoundingTerms inertia_terms(const mjModel& model, const mjData& data);

}  // namespace twincraft
