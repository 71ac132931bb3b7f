// What changes the books of a vehicle, from what an evaluation left in memory: summed over hub and
// limbs as their laws are, without a second motion of the tree.
// Tested by tests/runtime/books_test.cpp.
#pragma once

#include <type_traits>

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
    const Moment<H> mass = moment();
    if (falls()) books.force_N = mass.mass * fall();
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
    add_limbs([&](const auto& limb) { return limb.inner_power(state_); }, power);
    return power;
  }

  Moment<H> moment() const {
    Moment<H> sum{vehicle_.mass_.mass, vehicle_.mass_.moment};
    add_limbs([](const auto& limb) { return limb.moment(); }, sum);
    return sum;
  }

  void book_changes(const Moment<H>& mass, BooksOf<H>& books) {
    const H inverse_mass = H(1.0) / mass.mass;
    Tally<H> tally;
    tally.r_CB = inverse_mass * mass.moment;
    tally.v_CB = inverse_mass * momentum();
    const Mat<H> dcm_NB = vehicle_.turns_alone_ ? attitude() : vehicle_.dcm_NB_;
    if (loads_act()) tally.add_loads(loads(tally.r_CB), books);
    if (vehicle_.has_elements_) tally.add_gravity(gravity(vehicle_.field_), dcm_NB, books);
    if (vehicle_.tanks_.flow()) tally.add_leaving(leaving(vehicle_.field_, tally.r_CB), books);
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

  /// Lets limbs know their velocities.
  Vec<H> momentum() {
    const Vec<S> omega = vehicle_.spread(omega_);
    Vec<H> sum = cross(omega_, vehicle_.mass_.moment);
    const auto of = [&](auto& limb) {
      limb.trace(state_, omega);
      return limb.momentum();
    };
    add_limbs(of, sum);
    return sum;
  }

  Outside<H> loads(const Vec<H>& r_CB) const {
    Pull<H> on_hub = vehicle_.held_;
    if (vehicle_.push_.acts()) on_hub.add(vehicle_.pushed_);
    if (vehicle_.acts_at_center_) on_hub.add(vehicle_.held_at_center_, r_CB);
    Outside<H> outside;
    outside.add_on_hub(on_hub, omega_);
    if (!vehicle_.acts_on_limbs_ && !vehicle_.push_.acts()) return outside;
    const Vec<S> r_CB_S = vehicle_.spread(r_CB);
    const Vec<S>* center = vehicle_.acts_at_center_ ? &r_CB_S : nullptr;
    add_limbs([&](const auto& limb) { return limb.loads(center); }, outside);
    return outside;
  }

  Outside<H> gravity(const Field<H>& field) const {
    Outside<H> outside;
    for (const ElementNow<H>& element : vehicle_.elements_) {
      Pull<H> pull;
      pull.add(element.mass * field.difference(element.r_EL), element.r_EL);
      outside.add_on_hub(pull, omega_);
      if (field.has_gradient)
        outside.add_turn(field.gradient_torque(element.r_EL, element.I), omega_);
    }
    const Field<S> field_S = vehicle_.spread(field);
    add_limbs([&](const auto& limb) { return limb.gravity(field_S); }, outside);
    return outside;
  }

  Leaving<H> leaving(const Field<H>& field, const Vec<H>& r_CB) const {
    const Field<S> field_S = vehicle_.spread(field);
    const Field<S>* pulls = vehicle_.has_elements_ ? &field_S : nullptr;
    Leaving<H> sum;
    add_limbs([&](const auto& limb) { return limb.leaving(pulls); }, sum);
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

  /// @param of  what the limbs of one group say, side by side  @param sum  takes it of all limbs
  template <class Of, class Sum>
  void add_limbs(const Of& of, Sum& sum) const {
    add_particles(of, sum);
    vehicle_.limbs_.for_each_tree([&](auto& group) {
      const auto limbs = of(group.limb);
      if (group.is_full)  // asked once, not for every number
        sum += total<true>(limbs);
      else
        sum += total<false>(limbs);
    });
  }
  /// Of all groups in lanes first.
  template <class Of, class Sum>
  void add_particles(const Of& of, Sum& sum) const {
    if (!vehicle_.limbs_.has_particles()) return;
    std::remove_cvref_t<std::invoke_result_t<const Of&, Point<H, S>&>> limbs{};
    vehicle_.limbs_.for_each_particle([&](auto& group) { limbs += of(group.limb); });
    sum += total<true>(limbs);
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
