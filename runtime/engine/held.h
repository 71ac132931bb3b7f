// What an engine holds of a model: for proofs that two engines were built of the same numbers, and
// for how far rounding may take what an engine makes of them.
// Tested by tests/runtime/proof_test.cpp.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "compiler/ir/mass.h"

namespace twincraft {

/// A link and its joint, in the terms of Link and Joint. The hub has no joint.
struct HeldLink {
  MassProperties mass;  // at t = 0, of everything that moves with it, wheels included
  Vector3d r_HP_P = Vector3d::Zero();  // [m]
  double reach = 0.0;                  // [m] lengths that r_HP_P was added up of
  Matrix3d dcm_PL0 = Matrix3d::Identity();
  Vector3d axis_L = Vector3d::UnitZ();
  double stiffness = 0.0;  // [N m/rad] or [N/m]
  double damping = 0.0;    // [N m s/rad] or [N s/m]
  double rest = 0.0;       // [rad] or [m]
};

struct HeldWheel {
  Vector3d axis_L = Vector3d::UnitZ();  // mount axes
  double spin_inertia = 0.0;            // [kg m^2]
};

struct HeldMachine {
  std::vector<HeldLink> links;    // of the assembly, in its order
  std::vector<HeldWheel> wheels;  // of its rotors
};

/// How large the terms are that an engine adds up. Rounding is relative to them, not to the sums.
/// Both in the order of the velocity coordinates; empty: no term is larger than its sum.
struct RoundingTerms {
  Eigen::MatrixXd mass;   // of every entry of the mass matrix
  Eigen::VectorXd force;  // of every generalised force
};

}  // namespace twincraft
