// Gravity as the kernel feels it, in a frame that falls with the hub: what an element is pulled
// more than the hub is. The law is that of runtime/forces/forces.h, where it is explained, in any
// scalar. Tested by tests/runtime/bsm_test.cpp (against the force room and the dense oracle).
#pragma once

#include "runtime/bsm/linear.h"
#include "runtime/bsm/plan.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

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

/// -mu / r^3 and what goes with it.
template <class S>
struct Field {
  S mu{};
  Vec<S> r;  // [m] of B from the centre of the field
  S inverse_r2{}, strength{};
  bool has_gradient = false;  // elements feel their own gravity-gradient torque

  Field() = default;
  Field(const S& mu_, const Vec<S>& r_, const S& inverse_r2_, const S& strength_, bool gradient)
      : mu(mu_), r(r_), inverse_r2(inverse_r2_), strength(strength_), has_gradient(gradient) {}
  Field(const S& mu_, const Vec<S>& r_, bool gradient) : mu(mu_), r(r_), has_gradient(gradient) {
    const S r2 = dot(r, r);
    inverse_r2 = S(1.0) / r2;
    strength = -mu / (r2 * root(r2));
  }

  Vec<S> at_hub() const { return strength * r; }

  /// g(r + x) - g(r) by Battin's form.
  Vec<S> difference(const Vec<S>& x) const {
    const Vec<S> there = r + x;
    const S q = dot(x, there + r) * inverse_r2;
    const S one(1.0), three(3.0);
    const S s3 = (one + q) * root(one + q);
    const S shrink = q * (three + q * (three + q)) / (s3 * (s3 + one));
    return strength * (x - shrink * there);
  }

  /// 3 mu / r^3 rhat x (I rhat) of an element at x with inertia I, both in the axes of r.
  Vec<S> gradient_torque(const Vec<S>& x, const Sym<S>& I) const {
    const Vec<S> there = r + x;
    const S inverse = S(1.0) / dot(there, there);
    return (S(3.0) * mu * inverse * inverse * root(inverse)) * cross(there, I * there);
  }

  Field in_axes(const Mat<S>& dcm_WC) const {
    Field turned = *this;
    turned.r = transposed(dcm_WC, r);
    return turned;
  }
};

/// What gravity pulls on, see GravityElement.
template <class S>
struct Pulled {
  S mass{};
  Vec<S> r_EL;
  Sym<S> I;

  void set(std::size_t l, const GravityElement& from) {
    set_lane(r_EL, l, from.r_EL);
    set_mass(l, from);
  }
  void set_mass(std::size_t l, const GravityElement& from) {
    set_lane(mass, l, from.mass);
    set_lane(I, l, from.I_PntE_L);
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
