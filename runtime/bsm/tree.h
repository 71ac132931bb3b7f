// The constants of the analytic engine: an assembly prepared for the recursion. Flat arrays in
// preorder, every product of constants formed once. Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "compiler/ir/assembly.h"

namespace twincraft::bsm {

/// A link, its joint and its mass. A hinge at q turns the link by
///   dcm_PL(q) = turn_fixed + cos q turn_cos + sin q turn_sin        (Rodrigues)
struct LinkConstants {
  int parent = -1;
  int children = 0;  // how many links are joined to it
  JointKind kind = JointKind::kHinge;
  Matrix3d turn_fixed, turn_cos, turn_sin;  // a slide only uses turn_fixed = dcm_PL0
  // K: the link's axes turned so that the third is that of the joint, about which a hinge turns two
  // columns. The general path of the kernel works in them.
  Matrix3d dcm_KL, dcm_PK0;  // PK0: at zero
  Vector3d r_HP_P;           // [m] joint from the parent's origin
  Vector3d axis_P;           // unit, parent axes: a turn about it leaves it alone
  double stiffness = 0.0, damping = 0.0, rest = 0.0;
  int damped_by_cosine_of = -1;  // see Joint
  bool drains = false;           // its mass follows the tanks: see Draining

  double mass = 0.0;      // [kg] of all elements
  Vector3d first_moment;  // [kg m] mass times the centre of mass from the link's origin, link axes
  // About the link's origin, link axes, without the axial inertia of its rotors: the part of the
  // angular momentum that follows the link. Full inertia = J_L + sum Js g g^T.
  Matrix3d J_L;  // [kg m^2]
};

struct RotorConstants {
  int link = 0;
  Vector3d axis_L;
  double spin_inertia = 0.0;  // [kg m^2]
};

/// What LinkConstants says of mass, of a part of a link's elements.
struct MassSums {
  double mass = 0.0;                         // [kg]
  Vector3d first_moment = Vector3d::Zero();  // [kg m]
  Matrix3d J_L = Matrix3d::Zero();           // [kg m^2]

  void add(double share, const MassSums& part) {
    mass += share * part.mass;
    first_moment += share * part.first_moment;
    J_L += share * part.J_L;
  }
};

/// A link with elements of tanks: its sums are `fixed` + share * `full` of every tank's part.
struct Draining {
  struct Part {
    std::size_t tank = 0;
    MassSums full;
  };
  std::size_t link = 0;
  bool is_point = true;  // all that drains is at the link's origin and has no inertia there
  MassSums fixed;
  std::vector<Part> parts;
};

struct Tree {
  std::vector<LinkConstants> links;  // links[0]: the hub, joint unused
  std::vector<RotorConstants> rotors;
  std::vector<Draining> draining;
  std::size_t tanks = 0;  // that elements belong to

  /// Null: the link's mass is constant.
  const Draining* draining_of(std::size_t link) const;
};

Tree prepare(const Assembly& assembly);

/// Set the masses of draining links, full at first; one share per tank.
void set_shares(Tree& tree, std::span<const double> shares);

/// c [N m s/rad] or [N s/m] of a joint in this configuration.
inline double damping_of(const LinkConstants& link, std::span<const double> q) {
  if (link.damped_by_cosine_of < 0) return link.damping;
  const double cosine = std::cos(q[static_cast<std::size_t>(link.damped_by_cosine_of) - 1]);
  return link.damping * cosine * cosine;
}

}  // namespace twincraft::bsm
