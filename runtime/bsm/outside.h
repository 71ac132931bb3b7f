// What the books of one evaluation are made of, and what they come to. The kernel sums it up limb
// by limb from what the evaluation left in memory. Everything is about the hub's origin B, whose
// velocity is taken as zero until the end: on orbit it would cost four digits. Limbs say how they
// move as seen from the hub's axes, for the hub's own rotation omega is soon added to any sum: with
// v = omega x r + w,
//   sum m v = omega x sum m r + sum m w,  sum F.v = omega . sum r x F + sum F.w
// Tested by tests/runtime/books_test.cpp (against sums over elements in plain doubles).
#pragma once

#include "runtime/bsm/draining.h"
#include "runtime/bsm/parts.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

/// Masses, where they are and how they move.
template <class S>
struct MassMotion {
  Moment<S> moment;  // from B
  Vec<S> momentum;   // [N s]

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

/// What leaves with the mass that leaves, at fixed motion; the hub's rotation is in it.
template <class S>
struct Leaving {
  Moment<S> moment;  // [kg/s], [kg m/s]
  Vec<S> momentum;   // [N]
  Vec<S> H_PntB_B;   // [N m]
  S kinetic{};       // [W]
  S potential{};     // [W] beyond that of the same mass at B

  void add(const LinkMass<S>& rate, const MountMotion<S>& link) {
    const Vec<S>&r = link.r_LB, &v = link.v_LB;
    const Vec<S> first = link.dcm_WL * rate.moment;
    const Vec<S> turning = cross(link.omega, first);
    add_point(rate.mass, r, v);
    add_turning(first, link.dcm_WL * (rate.J * transposed(link.dcm_WL, link.omega)), link.omega);
    H_PntB_B += cross(r, turning) + cross(first, v);
    kinetic += dot(v, turning);
  }
  /// On a link whose origin is B, in its own axes.
  void add_on_hub(const LinkMass<S>& rate, const Vec<S>& omega) {
    moment.mass += rate.mass;
    add_turning(rate.moment, rate.J * omega, omega);
  }
  void add_point(const S& mass_rate, const Vec<S>& r, const Vec<S>& v) {
    const Vec<S> mv = mass_rate * v;
    moment += {mass_rate, mass_rate * r};
    momentum += mv;
    H_PntB_B += cross(r, mv);
    kinetic += S(0.5) * dot(mv, v);
  }
  void lift(const S& mass_rate, const Vec<S>& r, const Field<S>& field) {
    const Vec<S> there = field.r + r;
    potential += mass_rate * field.mu * (root(field.inverse_r2) - S(1.0) / root(dot(there, there)));
  }
  Leaving& operator+=(const Leaving& o) {
    moment += o.moment;
    momentum += o.momentum;
    H_PntB_B += o.H_PntB_B;
    kinetic += o.kinetic;
    potential += o.potential;
    return *this;
  }

 private:
  void add_turning(const Vec<S>& first, const Vec<S>& spin, const Vec<S>& omega) {
    moment.moment += first;
    momentum += cross(omega, first);
    H_PntB_B += spin;
    kinetic += S(0.5) * dot(omega, spin);
  }
};

/// BookRates in the numbers of the hub.
template <class H>
struct BooksOf {
  H power{}, own_power{};
  Vec<H> force_N, torque_PntC_N;
};

/// What changes the books of a vehicle beside its own efforts, summed in hub axes and turned into N
/// at the end. Sums about C follow from those about B.
template <class H>
struct Tally {
  Vec<H> omega, r_CB, v_CB;
  Pull<H> all{};     // and momenta that leave
  Vec<H> driving{};  // [N] of it what no potential covers
  H power{};         // [W] of all, and of leaving mass, with B at rest
  H lost_mass{};     // [kg/s]

  void add_loads(const Outside<H>& loads, BooksOf<H>& books) {
    books.power += add(loads);
    driving += loads.pull.force;
  }
  /// @param gravity  differences from that at B
  void add_gravity(const Outside<H>& gravity, const Mat<H>& dcm_NB, BooksOf<H>& books) {
    add(gravity);
    books.force_N += dcm_NB * gravity.pull.force;
    books.power += gravity.turn_power;
  }
  /// What C itself does drops out of H: neither sum of m (r - r_C) nor of m (v - v_C) is anything.
  void add_leaving(const Leaving<H>& leaving, BooksOf<H>& books) {
    const Moment<H>& lost = leaving.moment;
    all.force += leaving.momentum;
    all.torque += leaving.H_PntB_B - cross(lost.moment - lost.mass * r_CB, v_CB);
    driving += leaving.momentum;
    power += leaving.kinetic + (H(0.5) * lost.mass) * dot(v_CB, v_CB);
    lost_mass = lost.mass;
    books.power += leaving.kinetic + leaving.potential;
  }

  /// What B's own velocity makes of loads and leaving mass.
  void book_driving(const Mat<H>& dcm_NB, const Vec<H>& v_BN_N, BooksOf<H>& books) const {
    const Vec<H> driving_N = dcm_NB * driving, lost_N = lost_mass * v_BN_N;
    books.power += dot(driving_N + H(0.5) * lost_N, v_BN_N);
    books.force_N += driving_N + lost_N;
  }
  void book_own(const Mat<H>& dcm_NB, BooksOf<H>& books) const {
    books.own_power += power - dot(all.force, v_CB);
    books.torque_PntC_N = dcm_NB * (all.torque - cross(r_CB, all.force));
  }

 private:
  /// @return its power
  H add(const Outside<H>& outside) {
    const H works = outside.power + dot(omega, outside.pull.torque);
    all.add(outside.pull);
    power += works;
    return works;
  }
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
