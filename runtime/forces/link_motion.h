// What a force is told and what it answers, in any scalar.
#pragma once

#include "runtime/scalar/linear.h"

namespace twincraft::TWINCRAFT_KERNEL {

/// How a link moves, in working axes W. The velocity of B is left out: on orbit the difference of
/// two true velocities would lose four digits.
template <KernelScalar S>
struct LinkMotion {
  Mat<S> dcm_WL;
  Vec<S> omega;  // [rad/s] inertial
  Vec<S> r_LB;   // [m] its origin from the hub's
  Vec<S> v_LB;   // [m/s] of that, in axes that do not turn

  /// The velocity of a point of the link that is `r_PL` [m] from its origin.
  Vec<S> velocity_at(const Vec<S>& r_PL) const { return v_LB + cross(omega, r_PL); }
};

/// Where and when.
template <KernelScalar S>
struct Surroundings {
  S time{};               // [s]
  Vec<S> r_BN_N, v_BN_N;  // [m], [m/s]
  Mat<S> dcm_NW;
};

/// A force and its torque about some origin.
template <KernelScalar S>
struct Pull {
  Vec<S> force, torque;

  void add(const Vec<S>& more, const Vec<S>& at) {
    force += more;
    torque += cross(at, more);
  }
  void add(const Pull& more) {
    force += more.force;
    torque += more.torque;
  }
};

}  // namespace twincraft::TWINCRAFT_KERNEL
