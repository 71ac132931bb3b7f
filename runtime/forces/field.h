// Gravity of a point mass, once for every scalar: in a frame that falls with the hub an element
// feels only what it is pulled more than the hub is, computed without cancellation.
// Tested by tests/runtime/forces_test.cpp, and in the kernel's scalars by bsm_test.cpp (against the
// dense oracle).
#pragma once

#include "runtime/scalar/linear.h"

namespace twincraft::TWINCRAFT_KERNEL {

/// -mu / r^3 and what goes with it. The default one pulls on nothing.
template <KernelScalar S>
struct Field {
  S mu{};
  Vec<S> r;  // [m] of the hub's origin from the centre of the field
  S inverse_r2{}, strength{};
  bool has_gradient = false;  // elements feel their own gravity-gradient torque

  Field() = default;
  Field(const S& mu_, const Vec<S>& r_, const S& inverse_r2_, const S& strength_, bool gradient)
      : mu(mu_), r(r_), inverse_r2(inverse_r2_), strength(strength_), has_gradient(gradient) {}
  Field(const S& mu_, const Vec<S>& r_, bool gradient) : mu(mu_), r(r_), has_gradient(gradient) {
    const S r2 = dot(r, r);
    inverse_r2 = S(1.0) / r2;
    // The root and the quotient do not wait for each other.
    strength = -(mu * inverse_r2 * inverse_r2) * root(r2);
  }

  /// g at the hub's origin [m/s^2].
  Vec<S> at_hub() const { return strength * r; }

  /// g(r + x) - g(r) by Battin's form: relative error at rounding level for any |x| < |r|.
  Vec<S> difference(const Vec<S>& x) const {
    const Vec<S> there = r + x;
    const S q = dot(x, there + r) * inverse_r2;  // |r + x|^2 = r^2 (1 + q)
    const S one(1.0), three(3.0);
    const S s3 = (one + q) * root(one + q);
    // 1 - (1 + q)^(-3/2), as a quotient that keeps all digits of a small q.
    const S shrink = q * (three + q * (three + q)) / (s3 * (s3 + one));
    return strength * (x - shrink * there);
  }

  /// 3 mu / r^3 rhat x (I rhat) of an element at x with inertia I about its own centre, both in the
  /// axes of r (Hughes, Spacecraft Attitude Dynamics).
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

}  // namespace twincraft::TWINCRAFT_KERNEL
