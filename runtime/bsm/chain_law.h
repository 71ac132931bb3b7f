// What the links of a chain ask for, from leaf to root: see chain.h for the equations.
// Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include "runtime/bsm/outside.h"
#include "runtime/bsm/plane.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

/// alpha = gain - gain_f . a, and a of the next hinge is a + alpha perp(next) + bias. The gain is
/// kept by who asks for it.
template <class S>
struct Recovery {
  Vec2<S> gain_f, next, bias;
};

/// What the locked chain from a link on asks for against the plane, about that link's hinge and
/// as if that did not accelerate. Its mass and the mean of its inertia are constants. A link's own
/// inertia is here that of the link with all the mass beyond it at the next hinge.
template <class S>
struct LockedChain {
  Vec2<S> moment;     // [kg m]
  Plane<S> products;  // [kg m^2] of distances and moments beyond; of xx and zz one half
  Deviator<S> G;      // [kg m^2] sum of the links' own
  S f_s{};            // [N] bias force along s
  Vec2<S> lever;      // [N m] its moment: the torque is -perp(lever)
  Deviator<S> rates;  // [kg m^2/s] sum of (nu + ThetaDot) G
  Vec2<S> pulled;     // [N m] in-plane torque of pulls

  /// On the link, about its own hinge.
  void feel(const Pull<S>& pull) {
    f_s -= pull.force.y;
    pulled += in_plane(pull.torque);
  }
  /// From the next hinge to the link's own, d away, which makes the next one and all the mass
  /// beyond accelerate by a_s along s.
  void reach(const S& mass, const Vec2<S>& d, const S& a_s) {
    lever = lever + a_s * moment + f_s * d;
    f_s += mass * a_s;
    products.xx += d.z * moment.z;
    products.zz += d.x * moment.x;
    products.xz = products.xz - d.x * moment.z - d.z * moment.x;
    moment += mass * d;
  }
  /// A link's own part: its inertia, rate = nu + ThetaDot.
  void add(const Deviator<S>& own, const S& rate) {
    G.half += own.half;
    G.xz += own.xz;
    rates.half += rate * own.half;
    rates.xz += rate * own.xz;
  }
};

/// What the free chain from a link on asks for in the plane about that link's hinge:
/// f = h alpha + M a + f,  tau = J alpha + h.a + tau. Eliminated, it is f = M a + f.
/// A link waits for the one after it, so sums begin with what is known first.
template <class S>
struct FreeChain {
  Plane<S> M;
  Vec2<S> f, h;
  S J{}, tau{};

  void feel(const Pull<S>& pull) {
    f -= in_plane(pull.force);
    tau -= pull.torque.y;
  }
  /// From the next hinge to the link's own, d away. @param own_J  of the link
  void reach(const Vec2<S>& d, const Vec2<S>& bias, const S& own_J) {
    f.x = f.x + M.xx * bias.x + M.xz * bias.z;
    f.z = f.z + M.xz * bias.x + M.zz * bias.z;
    h = {M.xx * d.z - M.xz * d.x, M.xz * d.z - M.zz * d.x};
    const S twice_xz = (d.x + d.x) * d.z;  // not by h, which comes later than M
    J = (own_J + (d.z * d.z) * M.xx) + ((d.x * d.x) * M.zz - twice_xz * M.xz);
    tau = tau + d.z * f.x - d.x * f.z;
  }
  /// By the torque u on the joint, which the link before then feels. @return the gain
  S eliminate(const S& mass, const S& u, Recovery<S>& recovery) {
    const S xx = h.x * h.x, zz = h.z * h.z, xz = h.x * h.z;  // while the quotient is made
    const S inverse = S(1.0) / J;
    const S gain = inverse * (u - tau);
    recovery.gain_f = inverse * h;
    M.xx = (M.xx + mass) - inverse * xx;
    M.zz = (M.zz + mass) - inverse * zz;
    M.xz = M.xz - inverse * xz;
    f += gain * h;
    tau = u;
    return gain;
  }
};

/// A vector of a link as it is now, what the rates make of it in the plane, and how fast it would
/// leave the plane.
template <class S>
struct Carried {
  Vec2<S> v, bias;
  S leaves;

  Carried(const Vec2<S>& v_of, const Vec2<S>& bias_of, const S& leaves_of)
      : v(v_of), bias(bias_of), leaves(leaves_of) {}
  Carried(const Carried& o) : v(o.v), bias(o.bias), leaves(o.leaves) {}
  friend Carried operator*(const S& s, const Carried& c) {
    return {s * c.v, s * c.bias, s * c.leaves};
  }
};

/// The rate of the mount, as links feel it in the plane.
template <class S>
struct Turning {
  Vec2<S> omega;
  S xx, zz, product, twice_product, difference;

  explicit Turning(const Vec2<S>& of)
      : omega(of), xx(of.z * of.z), zz(of.x * of.x), product(of.x * of.z) {
    twice_product = product + product;
    difference = xx - zz;
  }
  /// omega x (omega x v) of a v that turns by nu in the plane.
  Carried<S> carry(const Vec2<S>& v, const S& nu2) const {
    return {v, {product * v.z - (xx + nu2) * v.x, product * v.x - (zz + nu2) * v.z}, dot(omega, v)};
  }
  S torque(const Deviator<S>& G) const { return G.half * twice_product + G.xz * difference; }
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
