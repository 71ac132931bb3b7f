// What the kernel is built from: the tree cut into the hub and its limbs, with the constants of
// each. A limb is what hangs on the hub by one joint; like limbs can share SIMD lanes, and tails
// whose hinges are parallel take the planar path. Everything here happens once, in doubles; a plan
// never changes, and any number of kernels may be built from it. Masses are those of full tanks.
// Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "compiler/ir/forces.h"
#include "compiler/ir/model.h"
#include "runtime/bsm/held_inputs.h"
#include "runtime/bsm/tree.h"

namespace twincraft::bsm {

struct LinkPlan {
  int link = 0;     // in the assembly
  int parent = -1;  // in the limb; -1: the hub
  bool slides = false;
  int damped_by_cosine_of = -1;       // in the limb; -1: of none
  std::vector<MassElement> elements;  // what gravity pulls on
  std::vector<int> rotors;            // in the assembly
};

struct PlanarLinkPlan {
  int link = 0;
  double mass = 0.0;
  std::array<double, 2> first_moment{};  // [kg m] from the hinge, (x, z) at angle zero
  std::array<double, 2> next{};          // [m] to the next hinge
  std::array<double, 3> G{};             // [kg m^2] in-plane inertia about the hinge: xx, zz, xz
  double J = 0.0;                        // [kg m^2] about s through the hinge
  double stiffness = 0.0, damping = 0.0, rest = 0.0;
  std::vector<MassElement> elements;  // r_EL_L in chain axes at angle zero
};

struct ChainPlan {
  int mount = -1;   // in the limb; -1: the hub
  Vector3d r_HP_P;  // [m] root hinge, mount axes
  Matrix3d dcm_PC;  // chain to mount axes
  std::vector<PlanarLinkPlan> links;
  /// Hinges, centres of mass and principal axes lie on the x axes of the links: no z, no xz. Masses
  /// are then so spread over hinges that only the last link has a first moment.
  bool is_straight = false;
};

/// Whose steps of the recursion are written out.
enum class LimbKind {
  kTree,   // any
  kChain,  // no links but those of one chain, on the hub
  kPoint,  // one link: a point mass on a slide
  kBob,    // a point mass at the end of two crossed hinges, that nothing acts on but gravity
};

struct LimbPlan {
  std::vector<LinkPlan> links;  // parents before children
  std::vector<ChainPlan> chains;
  LimbKind kind = LimbKind::kTree;
};

/// The same structure, whatever the constants: their limbs can go side by side.
bool are_alike(const LimbPlan& a, const LimbPlan& b);

struct Plan {
  Tree tree;
  AttitudeChart chart = AttitudeChart::kMrp;
  double mu = 0.0;  // [m^3/s^2]
  GravityLaw law = GravityLaw::kNone;
  Forces forces;  // that follow the motion of links
  LinkPlan hub;
  std::vector<LimbPlan> limbs;

  int joints() const { return static_cast<int>(tree.links.size()) - 1; }
  int rotors() const { return static_cast<int>(tree.rotors.size()); }
  double mass() const;  // [kg] of all links
  /// How many links the planar path serves.
  std::size_t planar_links() const;
};

/// The same structure, whatever the constants: such vehicles can be flown in lanes, and none of
/// them flies otherwise for what the others are.
bool are_alike(const Plan& a, const Plan& b);

/// @param loads, forces  what may act on a link, which excludes it from the planar path
/// @param paths  kGeneral: points and bobs too take the way that serves any tree
Plan make_plan(const Assembly& assembly, AttitudeChart chart, const Gravity& gravity,
               const std::vector<Load>& loads, ChainPath paths = ChainPath::kPlanar,
               Forces forces = {});

}  // namespace twincraft::bsm
