// What changes the books of a vehicle, from what an evaluation left in memory: summed over hub and
// limbs as their laws are, without a second motion of the tree.
// Tested by tests/runtime/books_test.cpp.
#pragma once

#include "runtime/bsm/vehicle.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

template <class H, class S>
class Bookkeeper {
 public:
  /// @param state  at which the vehicle's derivative() has last been asked
  Bookkeeper(Vehicle<H, S>& vehicle, const Number<H>* state)
      : vehicle_(vehicle), state_(state), omega_(vehicle.vector(state, vehicle.layout_.omega)) {}

  BooksOf<H> books() {
    const H inner = inner_power();
    BooksOf<H> books{inner, inner, {}, {}};
    const bool changes = acts() || vehicle_.tanks_.flow();
    if (!falls() && !changes) return books;
    const MassMotion<H> mass = motion();
    if (falls()) books.force_N = mass.moment.mass * fall();
    if (changes) book_changes(mass, books);
    return books;
  }

 private:
  bool falls() const { return vehicle_.plan_.law != GravityLaw::kNone; }
  bool loads_act() const {
    return vehicle_.acts_on_hub_ || vehicle_.acts_on_limbs_ || vehicle_.push_.acts();
  }
  bool acts() const { return loads_act() || vehicle_.has_elements_; }

  H inner_power() const {
    H power(0.0);
    for (const RotorOn<H, H>& rotor : vehicle_.rotors_) power += rotor.power(state_);
    return power + of_limbs<Power>([&](const auto& limb, Power<S>& sum) {
                     sum.power += limb.inner_power(state_);
                   }).power;
  }

  /// Lets limbs know their velocities.
  MassMotion<H> motion() {
    const Moment<H> hub{vehicle_.mass_.mass, vehicle_.mass_.moment};
    MassMotion<H> all = of_limbs<MassMotion>([&](auto& limb, MassMotion<S>& sum) {
      limb.trace(state_);
      limb.add_motion(sum);
    });
    all.moment += hub;
    return all;
  }

  void book_changes(const MassMotion<H>& mass, BooksOf<H>& books) const {
    const H inverse_mass = H(1.0) / mass.moment.mass;
    const Vec<H> r_CB = inverse_mass * mass.moment.moment;
    Tally<H> tally{omega_, r_CB, plus_cross(inverse_mass * mass.momentum, omega_, r_CB)};
    Mat<H> attitude_alone;
    if (vehicle_.turns_alone_) attitude_alone = attitude();
    const Mat<H>& dcm_NB = vehicle_.turns_alone_ ? attitude_alone : vehicle_.dcm_NB_;
    if (loads_act()) tally.add_loads(loads(r_CB), books);
    if (vehicle_.has_elements_) tally.add_gravity(gravity(), dcm_NB, books);
    if (vehicle_.tanks_.flow()) tally.add_leaving(leaving(r_CB), books);
    if (loads_act() || vehicle_.tanks_.flow())
      tally.book_driving(dcm_NB, vehicle_.vector(state_, 3), books);
    tally.book_own(dcm_NB, books);
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

  Outside<H> loads(const Vec<H>& r_CB) const {
    Outside<H> outside{vehicle_.held_};
    if (vehicle_.push_.acts()) outside.pull.add(vehicle_.pushed_);
    if (vehicle_.acts_at_center_) outside.pull.add(vehicle_.held_at_center_, r_CB);
    if (!vehicle_.acts_on_limbs_ && !vehicle_.push_.acts()) return outside;
    const Vec<S> r_CB_S = vehicle_.spread(r_CB);
    const Vec<S>* center = vehicle_.acts_at_center_ ? &r_CB_S : nullptr;
    outside +=
        of_limbs<Outside>([&](const auto& limb, Outside<S>& sum) { limb.add_loads(center, sum); });
    return outside;
  }

  Outside<H> gravity() const {
    const Field<S> field = vehicle_.spread(vehicle_.field_);
    Outside<H> outside =
        of_limbs<Outside>([&](const auto& limb, Outside<S>& sum) { limb.add_gravity(field, sum); });
    if (vehicle_.pulls_on_hub_) add_gravity_hub(outside);
    return outside;
  }
  void add_gravity_hub(Outside<H>& sum) const {
    const Field<H>& field = vehicle_.field_;
    for (const ElementNow<H>& element : vehicle_.elements_) {
      sum.pull.add(element.mass * field.difference(element.r_EL), element.r_EL);
      if (!field.has_gradient) continue;
      const Vec<H> torque = field.gradient_torque(element.r_EL, element.I);
      sum.pull.torque += torque;
      sum.turn_power += dot(torque, omega_);
    }
  }

  Leaving<H> leaving(const Vec<H>& r_CB) const {
    const Vec<S> omega = vehicle_.spread(omega_);
    const Field<H>& field = vehicle_.field_;
    const Field<S> field_S = vehicle_.spread(field);
    const Field<S>* pulls = vehicle_.has_elements_ ? &field_S : nullptr;
    Leaving<H> sum = of_limbs<Leaving>(
        [&](const auto& limb, Leaving<S>& of) { limb.add_leaving(omega, pulls, of); });
    add_leaving_hub(field, sum);
    if (!falls()) return sum;
    const Moment<H>& lost = sum.moment;
    sum.potential -= lost.mass * field.mu * root(field.inverse_r2);
    if (vehicle_.plan_.law == GravityLaw::kSystemCom)  // the field is that at C
      sum.potential -= dot(field.at_hub(), lost.moment - lost.mass * r_CB);
    return sum;
  }
  void add_leaving_hub(const Field<H>& field, Leaving<H>& sum) const {
    const LinkDrain<H, H>& draining = vehicle_.draining_;
    if (!draining.drains()) return;
    sum.add_on_hub(draining.mass_rate(), omega_);
    for (std::size_t e = 0; e < vehicle_.elements_.size(); ++e)
      sum.lift(draining.element_rate(e), vehicle_.elements_[e].r_EL, field);
  }

  template <class Of>
  struct Power {
    Of power{};
    Power& operator+=(const Power& o) {
      power += o.power;
      return *this;
    }
  };
  /// @param add  what a limb says, or like ones side by side, to a sum
  template <template <class> class Sum, class Add>
  Sum<H> of_limbs(const Add& add) const {
    Sum<H> all{};
    if (vehicle_.limbs_.has_particles()) {
      Sum<S> particles{};  // idle lanes weigh nothing
      vehicle_.limbs_.for_each_particle([&](auto& group) { add(group.limb, particles); });
      all = total<true>(particles);
    }
    vehicle_.limbs_.for_each_tree([&](auto& group) {
      Sum<S> limbs{};
      add(group.limb, limbs);
      all += group.is_full ? total<true>(limbs) : total<false>(limbs);
    });
    return all;
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
    return {total<kIsFull>(m.moment), total<kIsFull>(m.momentum)};
  }
  template <bool kIsFull>
  static Outside<H> total(const Outside<S>& o) {
    return {{total<kIsFull>(o.pull.force), total<kIsFull>(o.pull.torque)},
            total<kIsFull>(o.power),
            total<kIsFull>(o.turn_power)};
  }
  template <bool kIsFull>
  static Leaving<H> total(const Leaving<S>& o) {
    return {total<kIsFull>(o.moment), total<kIsFull>(o.momentum), total<kIsFull>(o.H_PntB_B),
            total<kIsFull>(o.kinetic), total<kIsFull>(o.potential)};
  }

  Vehicle<H, S>& vehicle_;
  const Number<H>* state_;
  Vec<H> omega_;
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
