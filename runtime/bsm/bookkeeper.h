// What changes the books of a vehicle, from what an evaluation left in memory: summed over hub and
// limbs as their laws are, without a second motion of the tree.
// Tested by tests/runtime/books_test.cpp.
#pragma once

#include "runtime/bsm/limb_books.h"
#include "runtime/bsm/particle_books.h"
#include "runtime/bsm/vehicle.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

template <class H, class S>
class Bookkeeper {
 public:
  /// @param state  at which the vehicle's derivative() has last been asked
  Bookkeeper(Vehicle<H, S>& vehicle, const Number<H>* state)
      : vehicle_(vehicle),
        particles_(vehicle.limbs_),
        state_(state),
        omega_(vehicle.vector(state, vehicle.layout_.omega)) {}

  BooksOf<H> books() {
    if (vehicle_.tanks_.flow()) return books_of_motion<true>();
    if (falls() || acts()) return books_of_motion<false>();
    BooksOf<H> books;
    books.power = books.own_power = with_rotors(inner_power());
    return books;
  }

 private:
  bool falls() const { return vehicle_.plan_.law != GravityLaw::kNone; }
  bool loads_act() const {
    return vehicle_.acts_on_hub_ || vehicle_.acts_on_limbs_ || vehicle_.push_.acts();
  }
  bool acts() const { return loads_act() || vehicle_.has_elements_; }

  H with_rotors(H power) const {
    for (const RotorOn<H, H>& rotor : vehicle_.rotors_) power += rotor.power(state_);
    return power;
  }
  /// Of limbs.
  H inner_power() const {
    return of_limbs<Power>(
               [&](const auto& limb, Power<S>& sum) { sum.power += limb.inner_power(state_); })
        .power;
  }

  /// @tparam kFlow  mass leaves the tanks
  template <bool kFlow>
  BooksOf<H> books_of_motion() {
    BooksOf<H> books;
    Change<H> change;
    const MassMotion<H> mass = motion<kFlow>(change);
    books.power = books.own_power = with_rotors(mass.inner_power);
    if (falls()) books.force_N = mass.moment.mass * fall();
    if (kFlow || acts()) book<kFlow>(change, mass, books);
    return books;
  }

  /// Lets limbs know their velocities. @param change  receives what leaves
  template <bool kFlow>
  MassMotion<H> motion(Change<H>& change) {
    MassMotion<H> all;
    if (vehicle_.limbs_.has_particles()) {
      Power<S> power{};
      vehicle_.limbs_.for_each_particle([&](auto& group) {
        power.power += group.limb.inner_power(state_);
        group.limb.trace(state_);
      });
      if constexpr (kFlow)
        all = particles_.motion(omega_, change);
      else
        all = particles_.motion();
      all.inner_power = total<true>(power).power;
    }
    add_trees<MassMotion>(all, [&](auto& limb, MassMotion<S>& sum) {
      sum.inner_power += limb.inner_power(state_);
      limb.trace(state_);
      limb.add_motion(sum);
    });
    if constexpr (kFlow)
      add_trees<Change>(change, [](const auto& limb, Change<S>& sum) { limb.add_leaving(sum); });
    all.moment += {vehicle_.mass_.mass, vehicle_.mass_.moment};
    if (kFlow && vehicle_.draining_.drains()) change.add(vehicle_.draining_.mass_rate(), omega_);
    return all;
  }

  /// @param change  of it what leaves; receives all else
  template <bool kFlow>
  void book(Change<H>& change, const MassMotion<H>& mass, BooksOf<H>& books) {
    const H minus_inverse = H(-1.0) / mass.moment.mass;
    const Vec<H> r_BC = minus_inverse * mass.moment.moment;
    const Vec<H> v_BC = plus_cross(minus_inverse * mass.momentum, omega_, r_BC);
    if (vehicle_.turns_alone_) vehicle_.dcm_NB_ = attitude();
    const Mat<H>& dcm_NB = vehicle_.dcm_NB_;
    if (loads_act()) change.add(loads(r_BC), omega_);
    if (kFlow || loads_act()) {  // which no potential covers
      const Vec<H> v_BN_N = vehicle_.vector(state_, 3);
      const Vec<H> from_B = dcm_NB * change.pull.force;
      const Vec<H> force_N = from_B + change.leaving.mass * v_BN_N;
      books.force_N += force_N;
      books.power += change.power + H(0.5) * dot(from_B + force_N, v_BN_N);
      if (kFlow && falls()) books.power += lost_potential(r_BC, change.leaving);
    }
    if (vehicle_.has_elements_) {
      const Outside<H> pulls = gravity();  // differences from that at B
      books.force_N += dcm_NB * pulls.pull.force;
      books.power += pulls.turn_power;
      change.add(pulls, omega_);
    }
    books.own_power += change.template power_about<kFlow>(v_BC);
    books.torque_PntC_N = dcm_NB * change.template torque_about<kFlow>(r_BC, v_BC);
  }
  // What a vehicle that turns alone does not leave behind.
  Vec<H> fall() const {
    return vehicle_.turns_alone_
               ? Field<H>(vehicle_.mu_, vehicle_.vector(state_, 0), false).at_hub()
               : vehicle_.g_N_;
  }
  Mat<H> attitude() const {
    return vehicle_.plan_.chart == AttitudeChart::kMrp
               ? Mrp<H>(state_, Layout::kAttitude).dcm_NB()
               : Quaternion<H>(state_, Layout::kAttitude).dcm_NB();
  }

  Outside<H> loads(const Vec<H>& r_BC) const {
    Outside<H> outside{vehicle_.held_};
    if (vehicle_.push_.acts()) outside.pull.add(vehicle_.pushed_);
    const Vec<H> r_CB = -r_BC;
    if (vehicle_.acts_at_center_) outside.pull.add(vehicle_.held_at_center_, r_CB);
    if (!vehicle_.acts_on_limbs_ && !vehicle_.push_.acts()) return outside;
    const Vec<S> r_CB_S = vehicle_.spread(r_CB);
    const Vec<S>* at = vehicle_.acts_at_center_ ? &r_CB_S : nullptr;
    outside +=
        of_limbs<Outside>([&](const auto& limb, Outside<S>& sum) { limb.add_loads(at, sum); });
    return outside;
  }

  Outside<H> gravity() const {
    Outside<H> outside;
    if (vehicle_.limbs_.has_particles()) outside = particles_.gravity(vehicle_.field_);
    const Field<S> field = vehicle_.spread(vehicle_.field_);
    add_trees<Outside>(outside,
                       [&](const auto& limb, Outside<S>& sum) { limb.add_gravity(field, sum); });
    if (vehicle_.pulls_on_hub_) {
      outside.pull.add(vehicle_.pulled_hub_);
      outside.turn_power += dot(vehicle_.turned_hub_, omega_);
    }
    return outside;
  }

  /// Beyond that of the same mass where B is and does not move.
  H lost_potential(const Vec<H>& r_BC, const Moment<H>& lost) const {
    const Field<H>& field = vehicle_.field_;
    H power = -(lost.mass * field.mu * root(field.inverse_r2));
    if (vehicle_.plan_.law == GravityLaw::kSystemCom)  // the field is that at C
      power -= dot(field.at_hub(), lost.moment + lost.mass * r_BC);
    if (!vehicle_.has_elements_) return power;
    Power<H> lift;
    if (vehicle_.limbs_.has_particles()) lift = particles_.lift(field);
    const Field<S> field_S = vehicle_.spread(field);
    add_trees<Power>(lift, [&](const auto& limb, Power<S>& sum) { limb.add_lifted(field_S, sum); });
    power += lift.power;
    for (std::size_t e = 0; e < vehicle_.elements_.size(); ++e)
      power += lifted(vehicle_.draining_.element_rate(e), vehicle_.elements_[e].r_EL, field);
    return power;
  }

  /// @param add  what a limb says, or like ones side by side, to a sum
  template <template <class> class Sum, class Add>
  Sum<H> of_limbs(const Add& add) const {
    Sum<H> all{};
    if (vehicle_.limbs_.has_particles()) {
      Sum<S> particles{};  // idle lanes weigh nothing
      vehicle_.limbs_.for_each_particle([&](auto& group) { add(group.limb, particles); });
      all = total<true>(particles);
    }
    add_trees<Sum>(all, add);
    return all;
  }
  /// But of particles.
  template <template <class> class Sum, class Add>
  void add_trees(Sum<H>& all, const Add& add) const {
    vehicle_.limbs_.for_each_tree([&](auto& group) {
      Sum<S> limbs{};
      add(group.limb, limbs);
      all += group.is_full ? total<true>(limbs) : total<false>(limbs);
    });
  }
  // See gathered().
  template <bool kIsFull>
  static H total(const S& value) {
    return gathered<H, S>(value, kIsFull);
  }
  template <bool kIsFull>
  static Vec<H> total(const Vec<S>& v) {
    return {total<kIsFull>(v.x), total<kIsFull>(v.y), total<kIsFull>(v.z)};
  }
  template <bool kIsFull>
  static Moment<H> total(const Moment<S>& m) {
    return {total<kIsFull>(m.mass), total<kIsFull>(m.moment)};
  }
  template <bool kIsFull>
  static Power<H> total(const Power<S>& p) {
    return {total<kIsFull>(p.power)};
  }
  template <bool kIsFull>
  static MassMotion<H> total(const MassMotion<S>& m) {
    return {total<kIsFull>(m.moment), total<kIsFull>(m.momentum), total<kIsFull>(m.inner_power)};
  }
  template <bool kIsFull>
  static Outside<H> total(const Outside<S>& o) {
    return {{total<kIsFull>(o.pull.force), total<kIsFull>(o.pull.torque)},
            total<kIsFull>(o.power),
            total<kIsFull>(o.turn_power)};
  }
  template <bool kIsFull>
  static Change<H> total(const Change<S>& c) {
    return {total<kIsFull>(c.leaving),
            {total<kIsFull>(c.pull.force), total<kIsFull>(c.pull.torque)},
            total<kIsFull>(c.power)};
  }

  Vehicle<H, S>& vehicle_;
  ParticleBooks<H, S> particles_;
  const Number<H>* state_;
  Vec<H> omega_;
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
