// The constants of the analytic engine: an assembly prepared for the recursion. Flat arrays in
// preorder, every product of constants formed once. Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include <vector>

#include "compiler/ir/assembly.h"
#include "runtime/bsm/sym3.h"

namespace twincraft::bsm {

/// A link, its joint and its mass. A hinge at q turns the link by
///   dcm_PL(q) = turn_fixed + cos q turn_cos + sin q turn_sin        (Rodrigues)
struct LinkConstants {
  int parent = -1;
  JointKind kind = JointKind::kHinge;
  Matrix3d turn_fixed, turn_cos, turn_sin;  // a slide only uses turn_fixed = dcm_PL0
  Vector3d r_HP_P;                          // [m] joint from the parent's origin
  Vector3d axis_P;                          // unit, parent axes: a turn about it leaves it alone
  double stiffness = 0.0, damping = 0.0, rest = 0.0;

  double mass = 0.0;      // [kg] of all elements
  Vector3d first_moment;  // [kg m] mass times the centre of mass from the link's origin, link axes
  // About the link's origin, link axes, without the axial inertia of its rotors: the part of the
  // angular momentum that follows the link. Full inertia = J_L + sum Js g g^T.
  Sym3 J_L;  // [kg m^2]
};

struct RotorConstants {
  int link = 0;
  Vector3d axis_L;
  double spin_inertia = 0.0;  // [kg m^2]
};

struct Tree {
  std::vector<LinkConstants> links;  // links[0]: the hub, joint unused
  std::vector<RotorConstants> rotors;
};

Tree prepare(const Assembly& assembly);

}  // namespace twincraft::bsm
