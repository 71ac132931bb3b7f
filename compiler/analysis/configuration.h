// Where every link is and how it moves, seen from the hub: the small forward kinematics that the
// compiler needs to place the initial state and to prove the two halves equal. The engines have
// their own; this one is written for clarity and shares nothing with them.
// Tested by tests/compiler/configuration_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "compiler/ir/assembly.h"

namespace twincraft {

/// Pose and motion of a link's frame L relative to the hub frame B, in B components. Rates are
/// derivatives seen in B: the hub's own motion is left out.
struct LinkMotion {
  Matrix3d dcm_BL = Matrix3d::Identity();
  Vector3d r_LB_B = Vector3d::Zero();      // [m] link origin from B
  Vector3d omega_LB_B = Vector3d::Zero();  // [rad/s]
  Vector3d v_LB_B = Vector3d::Zero();      // [m/s]
};

/// One entry per link, the hub first (and at rest).
/// @param q     joint positions [rad] or [m], one per link but the hub
/// @param qDot  their rates
std::vector<LinkMotion> configuration(const Assembly& assembly, std::span<const double> q,
                                      std::span<const double> qDot);

/// Mass, centre of mass from B and inertia about the centre of mass, all links together, B axes.
MassProperties system_properties(const Assembly& assembly, std::span<const LinkMotion> links);

/// c' [m/s]: rate of the system centre of mass seen in B, mass-weighted. @pre some link has mass
Vector3d center_of_mass_rate(const Assembly& assembly, std::span<const LinkMotion> links);

}  // namespace twincraft
