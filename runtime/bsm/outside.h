// What limbs are asked for by the books, summed up from what an evaluation left in memory. The
// velocity of the hub's origin B is taken as zero until the end: on orbit it would cost four
// digits. All sums are about B, and limbs say how they move as seen from the hub's axes, for the
// hub's own rotation omega is soon added to any sum: with v = omega x r + w,
//   sum m v = omega x sum m r + sum m w,  sum F.v = omega . sum r x F + sum F.w
// What leaves is told with v itself.
// Tested by tests/runtime/books_test.cpp (against sums over elements in plain doubles).
#pragma once

#include "runtime/bsm/draining.h"
#include "runtime/bsm/parts.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

/// A sum of power alone [W], or of energy.
template <class S>
struct Power {
  S power{};

  Power& operator+=(const Power& o) {
    power += o.power;
    return *this;
  }
};

/// Masses, where they are and how they move.
template <class S>
struct MassMotion {
  Moment<S> moment;  // from B
  Vec<S> momentum;   // [N s]
  S inner_power{};   // [W]

  void add_at(const S& mass, const Vec<S>& r, const Vec<S>& v) {
    moment += {mass, mass * r};
    momentum += mass * v;
  }
  /// From seen in the mount's axes to seen as the mount itself is.
  void carry(const MountMotion<S>& mount) {
    momentum +=
        moment.mass * mount.v_LB + cross(mount.omega, moment.moment - moment.mass * mount.r_LB);
  }
  MassMotion& operator+=(const MassMotion& o) {
    moment += o.moment;
    momentum += o.momentum;
    inner_power += o.inner_power;
    return *this;
  }
};

/// What acts on links from outside.
template <class S>
struct Outside {
  Pull<S> pull;    // hub axes, about B
  S power{};       // [W]
  S turn_power{};  // [W] by gravity-gradient torques, inertial: no potential covers it

  /// @param on_link  about the link's origin
  void add(const Pull<S>& on_link, const MountMotion<S>& link) {
    pull.force += on_link.force;
    pull.torque += on_link.torque + cross(link.r_LB, on_link.force);
    power += dot(on_link.force, link.v_LB) + dot(on_link.torque, link.omega);
  }
  /// As of MassMotion.
  void carry(const MountMotion<S>& mount) {
    power +=
        dot(pull.force, mount.v_LB) + dot(mount.omega, pull.torque - cross(mount.r_LB, pull.force));
  }
  void add_turn(const Vec<S>& torque, const Vec<S>& omega) {
    const S works = dot(torque, omega);
    pull.torque += torque;
    power += works;
    turn_power += works;
  }
  Outside& operator+=(const Outside& o) {
    pull.force += o.pull.force;
    pull.torque += o.pull.torque;
    power += o.power;
    turn_power += o.turn_power;
    return *this;
  }
};

/// What leaves with mass that leaves as it moves.
template <class S>
struct Leaving {
  Moment<S> moment;  // [kg/s], [kg m/s]
  Pull<S> pull;      // [N], [N m] momentum, and angular momentum about B
  S power{};         // [W]

  /// @param link  how it moves
  void add(const LinkMass<S>& rate, const MountMotion<S>& link) {
    const Vec<S> first = link.dcm_WL * rate.moment;
    const Vec<S> spin = link.dcm_WL * (rate.J * transposed(link.dcm_WL, link.omega));
    const Vec<S> momentum = plus_cross(rate.mass * link.v_LB, link.omega, first);
    const Vec<S> H_PntL_B = plus_cross(spin, first, link.v_LB);  // about the link's origin
    moment += {rate.mass, rate.mass * link.r_LB + first};
    pull.force += momentum;
    pull.torque += plus_cross(H_PntL_B, link.r_LB, momentum);
    power += S(0.5) * (dot(momentum, link.v_LB) + dot(H_PntL_B, link.omega));
  }
};

/// What mass that leaves at r takes along of potential, beyond that of the same mass at B [W].
template <class S>
S lifted(const S& mass_rate, const Vec<S>& r, const Field<S>& field) {
  const Vec<S> there = field.r + r;
  return mass_rate * field.mu * (root(field.inverse_r2) - S(1.0) / root(dot(there, there)));
}

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
