// What the books of one evaluation are made of, and what they come to. The kernel sums it up limb
// by limb from what the evaluation left in memory. The velocity of the hub's origin B is taken as
// zero until the end: on orbit it would cost four digits. All but what leaves is about B, and limbs
// say how they move as seen from the hub's axes, for the hub's own rotation omega is soon added to
// any sum: with v = omega x r + w,
//   sum m v = omega x sum m r + sum m w,  sum F.v = omega . sum r x F + sum F.w
// What leaves is about the centre of mass C, where its sums are those that the books ask for.
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

/// How B moves about the centre of mass C: what is told from B is told from C once this is added.
template <class S>
struct CenterMotion {
  Vec<S> omega;       // of the hub
  Vec<S> r_BC, w_BC;  // [m], [m/s] seen from the hub's axes

  Vec<S> v_BC() const { return plus_cross(w_BC, omega, r_BC); }
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
  /// On a particle. @param r, v  of it
  void add_at(const Vec<S>& force, const Vec<S>& r, const Vec<S>& v) {
    pull.add(force, r);
    power += dot(force, v);
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

/// What changes the energy and the angular momentum about C, as if that did not move.
template <class H>
struct Own {
  H power{};             // [W]
  Vec<H> torque_PntC_B;  // [N m]

  void set(const Outside<H>& outside, const CenterMotion<H>& center) {
    const Vec<H>& force = outside.pull.force;
    torque_PntC_B = plus_cross(outside.pull.torque, center.r_BC, force);
    power = outside.power + dot(force, center.w_BC) + dot(center.omega, torque_PntC_B);
  }
  void add(const Outside<H>& outside, const CenterMotion<H>& center) {
    Own more;
    more.set(outside, center);
    power += more.power;
    torque_PntC_B += more.torque_PntC_B;
  }
};

/// What leaves with the mass that leaves, at fixed motion, about C and as if that did not move.
/// What C itself does drops out of the books: neither sum of m (r - r_C) nor of m (v - v_C) is
/// anything.
template <class S>
struct Leaving {
  S mass{};         // [kg/s]
  Vec<S> momentum;  // [N]
  Vec<S> H_PntC_B;  // [N m]
  S kinetic{};      // [W]

  /// @param dcm_WL, omega  of a link  @param r, v  of its origin from C
  void add(const LinkMass<S>& rate, const Mat<S>& dcm_WL, const Vec<S>& omega, const Vec<S>& r,
           const Vec<S>& v) {
    add(rate.mass, dcm_WL * rate.moment, dcm_WL * (rate.J * transposed(dcm_WL, omega)), omega, r,
        v);
  }
  /// Of a link in hub axes.
  void add(const LinkMass<S>& rate, const Vec<S>& omega, const Vec<S>& r, const Vec<S>& v) {
    add(rate.mass, rate.moment, rate.J * omega, omega, r, v);
  }
  /// Of a particle.
  void add_point(const S& mass_rate, const Vec<S>& r, const Vec<S>& v) {
    const Vec<S> mv = mass_rate * v;
    mass += mass_rate;
    momentum += mv;
    H_PntC_B = plus_cross(H_PntC_B, r, mv);
    kinetic += S(0.5) * dot(mv, v);
  }
  Leaving& operator+=(const Leaving& o) {
    mass += o.mass;
    momentum += o.momentum;
    H_PntC_B += o.H_PntC_B;
    kinetic += o.kinetic;
    return *this;
  }

 private:
  /// @param first, spin  about the link's origin, hub axes
  void add(const S& mass_rate, const Vec<S>& first, const Vec<S>& spin, const Vec<S>& omega,
           const Vec<S>& r, const Vec<S>& v) {
    const Vec<S> own_momentum = plus_cross(mass_rate * v, omega, first);
    const Vec<S> H_PntL_B = plus_cross(spin, first, v);  // about the link's origin
    mass += mass_rate;
    momentum += own_momentum;
    H_PntC_B += plus_cross(H_PntL_B, r, own_momentum);
    kinetic += S(0.5) * (dot(own_momentum, v) + dot(H_PntL_B, omega));
  }
};

/// What mass that leaves at r takes along of potential, beyond that of the same mass at B [W].
template <class S>
S lifted(const S& mass_rate, const Vec<S>& r, const Field<S>& field) {
  const Vec<S> there = field.r + r;
  return mass_rate * field.mu * (root(field.inverse_r2) - S(1.0) / root(dot(there, there)));
}

/// BookRates in the numbers of the hub.
template <class H>
struct BooksOf {
  H power{}, own_power{};
  Vec<H> force_N, torque_PntC_N;
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
