// What the books of one evaluation are made of, and what they come to. The kernel sums it up limb
// by limb from what the evaluation left in memory. Everything is about the hub's origin B, whose
// velocity is taken as zero until the end: on orbit it would cost four digits.
// Tested by tests/runtime/books_test.cpp (against sums over elements in plain doubles).
#pragma once

#include "runtime/bsm/draining.h"
#include "runtime/bsm/parts.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

/// What acts on links from outside.
template <class S>
struct Outside {
  Pull<S> pull;    // hub axes, about B
  S power{};       // [W]
  S turn_power{};  // [W] of it by gravity-gradient torques, which no potential covers

  /// @param on_link  about the link's origin
  void add(const Pull<S>& on_link, const MountMotion<S>& link) {
    pull.force += on_link.force;
    pull.torque += on_link.torque + cross(link.r_LB, on_link.force);
    power += dot(on_link.force, link.v_LB) + dot(on_link.torque, link.omega);
  }
  void add_turn(const Vec<S>& torque, const MountMotion<S>& link) {
    const S works = dot(torque, link.omega);
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

/// What leaves with the mass that leaves, at fixed motion.
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

/// All mass of a vehicle, and what changes its books beside it.
template <class H>
struct Tally {
  Moment<H> moment;
  Vec<H> momentum;  // [kg m/s]

  Vec<H> r_CB() const { return (H(1.0) / moment.mass) * moment.moment; }
  Vec<H> v_CB() const { return (H(1.0) / moment.mass) * momentum; }

  /// @pre momentum is set, as for what follows
  void book_loads(const Outside<H>& loads, const Mat<H>& dcm_NB, const Vec<H>& v_BN_N,
                  BooksOf<H>& books) const {
    const Vec<H> force_N = book_outside(loads, dcm_NB, books);
    books.power += loads.power + dot(force_N, v_BN_N);
  }
  /// @param gravity  differences from that at B
  void book_gravity(const Outside<H>& gravity, const Mat<H>& dcm_NB, BooksOf<H>& books) const {
    book_outside(gravity, dcm_NB, books);
    books.power += gravity.turn_power;
  }
  /// Sums about C follow from those about B. What C itself does drops out of H: neither sum of
  /// m (r - r_C) nor of m (v - v_C) is anything.
  void book_leaving(const Leaving<H>& leaving, const Mat<H>& dcm_NB, const Vec<H>& v_BN_N,
                    BooksOf<H>& books) const {
    const Moment<H>& lost = leaving.moment;
    const Vec<H> r = r_CB(), v = v_CB(), p_N = dcm_NB * leaving.momentum;
    const Vec<H> half_v = H(0.5) * v, half_v_N = H(0.5) * v_BN_N;
    books.power += leaving.kinetic + dot(p_N + lost.mass * half_v_N, v_BN_N) + leaving.potential;
    books.own_power += leaving.kinetic - dot(leaving.momentum - lost.mass * half_v, v);
    books.force_N += p_N + lost.mass * v_BN_N;
    books.torque_PntC_N += dcm_NB * (leaving.H_PntB_B - cross(r, leaving.momentum) -
                                     cross(lost.moment - lost.mass * r, v));
  }

 private:
  /// @return the force in N
  Vec<H> book_outside(const Outside<H>& outside, const Mat<H>& dcm_NB, BooksOf<H>& books) const {
    const Vec<H>& force = outside.pull.force;
    const Vec<H> force_N = dcm_NB * force;
    books.own_power += outside.power - dot(force, v_CB());
    books.force_N += force_N;
    books.torque_PntC_N += dcm_NB * (outside.pull.torque - cross(r_CB(), force));
    return force_N;
  }
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
