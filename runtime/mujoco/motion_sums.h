// Mass, momentum and energy of a MuJoCo model in motion, summed over its own bodies with its own
// masses, so that the books of this engine owe nothing to the analytic one.
// Tested by tests/runtime/mujoco_test.cpp.
#pragma once

#include <mujoco/mujoco.h>

#include "compiler/ir/mass.h"

namespace twincraft {

struct MotionSums {
  double mass = 0.0;                     // [kg]
  Vector3d r_CB_N = Vector3d::Zero();    // [m] system centre of mass from the hub origin
  Vector3d v_CN_N = Vector3d::Zero();    // [m/s]
  double kinetic = 0.0;                  // [J] in N
  double own_kinetic = 0.0;              // [J] about C
  Vector3d momentum = Vector3d::Zero();  // [kg m/s] in N
  Vector3d H_PntC_N = Vector3d::Zero();  // [kg m^2/s]
  double momentum_scale = 0.0;           // sum of the bodies' magnitudes
  double H_scale = 0.0;
};

/// @pre mj_kinematics, mj_comPos and mj_comVel have run with the hub's origin at rest at zero
/// @param v_BN_N  the hub origin's true velocity [m/s]
MotionSums sum_motion(const mjModel& model, const mjData& data, const Vector3d& v_BN_N);

/// The system's centre of mass, in the world's axes W of the same placement.
struct BodyCenter {
  double mass = 0.0;                   // [kg]
  Vector3d r_CB_W = Vector3d::Zero();  // [m] from the hub origin
  Vector3d v_CB_W = Vector3d::Zero();  // [m/s]
};
/// @pre as of sum_motion()
BodyCenter center_of(const mjModel& model, const mjData& data);

/// What leaves the books because bodies lose mass: their rates at fixed motion.
struct LeavingSums {
  double kinetic = 0.0;                  // [W] of the motion in N
  double own_kinetic = 0.0;              // [W] about C
  Vector3d momentum = Vector3d::Zero();  // [N] of the motion in N, components in W
  Vector3d H_PntC_W = Vector3d::Zero();  // [N m]
};

/// A body that loses mass, and inertia in proportion.
struct Loss {
  int body = 0;
  double relative_rate = 0.0;  // [1/s] d(mass)/dt / mass
};

/// What one body adds. @param center  of this instant
LeavingSums leaving(const mjModel& model, const mjData& data, const Vector3d& v_BN_W,
                    const BodyCenter& center, const Loss& loss);

}  // namespace twincraft
