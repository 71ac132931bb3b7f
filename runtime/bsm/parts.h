// What the parts of the kernel say to each other: where coordinates are, how a mount moves, what is
// pulled and how much.  Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include "runtime/bsm/plan.h"
#include "runtime/forces/field.h"
#include "runtime/scalar/linear.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

using namespace ::twincraft::TWINCRAFT_KERNEL;

/// Where the coordinates of links are in a state.
struct Layout {
  int omega = 0, joint = 0, joint_rate = 0, wheel = 0;
  static constexpr int kAttitude = 6;
  int position(int link) const { return joint + link - 1; }
  int rate(int link) const { return joint_rate + link - 1; }
};

/// How a mount moves, in hub axes.
template <class S>
struct MountMotion {
  Mat<S> dcm_WL;
  Vec<S> omega;  // [rad/s] inertial
  Vec<S> r_LB;   // [m] its origin from the hub's
};

/// What gravity pulls on: an element in the axes of its link, of a chain in the chain's.
template <class S>
struct Pulled {
  S mass{};
  Vec<S> r_EL;
  Sym<S> I;  // about its own centre

  void set(std::size_t l, const ElementNow& from) {
    set_lane(r_EL, l, from.full.r_EL_L);
    set_mass(l, from);
  }
  void set_mass(std::size_t l, const ElementNow& from) {
    set_lane(mass, l, from.mass());
    set_lane(I, l, from.I_PntE_L());
  }
};

/// Mass, and mass times place from B.
template <class S>
struct Moment {
  S mass{};       // [kg]
  Vec<S> moment;  // [kg m]

  Moment& operator+=(const Moment& o) {
    mass += o.mass;
    moment += o.moment;
    return *this;
  }
};

/// A force and its torque about some origin.
template <class S>
struct Pull {
  Vec<S> force, torque;

  void add(const Vec<S>& more, const Vec<S>& at) {
    force += more;
    torque += cross(at, more);
  }
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
