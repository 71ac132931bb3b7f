// Mass and inertia as MuJoCo takes them, and loses nothing of them. Tested by
// tests/runtime/mjcf_test.cpp.
#pragma once

#include "compiler/ir/mass.h"

namespace twincraft {

struct MujocoInertial {
  double mass = 0.0;                   // [kg]
  Vector3d r_CL_L = Vector3d::Zero();  // [m]
  PrincipalInertia principal;          // about C, see told_inertia()
};

/// The nearest that MuJoCo accepts: masses and moments below 1e-15 are raised, and where rounding
/// left A + B < C, C is lowered to the sum.
MujocoInertial mujoco_inertial(const MassProperties& properties);

}  // namespace twincraft
