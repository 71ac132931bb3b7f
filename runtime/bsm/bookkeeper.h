// What changes the books of a vehicle, from what an evaluation left in memory: summed over hub and
// limbs as their laws are, without a second motion of the tree.
// Tested by tests/runtime/books_test.cpp.
#pragma once

#include "runtime/bsm/limb_books.h"
#include "runtime/bsm/vehicle.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

template <class H, class S>
class Bookkeeper {
 public:
  /// @param state  at which the vehicle's derivative() has last been asked
  Bookkeeper(Vehicle<H, S>& vehicle, const Number<H>* state)
      : vehicle_(vehicle), state_(state), omega_(vehicle.vector(state, vehicle.layout_.omega)) {}

  BooksOf<H> books() {
    BooksOf<H> books;
    if (falls() || acts() || vehicle_.tanks_.flow()) {
      const MassMotion<H> mass = motion();
      books.power = books.own_power = with_rotors(mass.inner_power);
      if (falls()) books.force_N = mass.moment.mass * fall();
      if (acts() || vehicle_.tanks_.flow()) book_changes(mass, books);
    } else {
      books.power = books.own_power = with_rotors(inner_power());
    }
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

  /// Lets limbs know their velocities.
  MassMotion<H> motion() {
    MassMotion<H> all = of_limbs<MassMotion>([&](auto& limb, MassMotion<S>& sum) {
      sum.inner_power += limb.inner_power(state_);
      limb.trace(state_);
      limb.add_motion(sum);
    });
    all.moment += {vehicle_.mass_.mass, vehicle_.mass_.moment};
    return all;
  }

  void book_changes(const MassMotion<H>& mass, BooksOf<H>& books) {
    const H minus_inverse = H(-1.0) / mass.moment.mass;
    const CenterMotion<H> center{omega_, minus_inverse * mass.moment.moment,
                                 minus_inverse * mass.momentum};
    if (vehicle_.turns_alone_) vehicle_.dcm_NB_ = attitude();
    const Mat<H>& dcm_NB = vehicle_.dcm_NB_;
    Own<H> own;
    if (loads_act() || vehicle_.tanks_.flow()) own = book_driving(center, books);
    if (vehicle_.has_elements_) {
      const Outside<H> pulls = gravity();  // differences from that at B
      books.force_N += dcm_NB * pulls.pull.force;
      books.power += pulls.turn_power;
      own.add(pulls, center);
    }
    books.own_power += own.power;
    books.torque_PntC_N = dcm_NB * own.torque_PntC_B;
  }
  /// Loads and leaving mass: no potential covers their forces.
  Own<H> book_driving(const CenterMotion<H>& center, BooksOf<H>& books) const {
    const Vec<H> v_BC = center.v_BC(), v_BN_N = vehicle_.vector(state_, 3);
    Own<H> own;
    Vec<H> force_B{};
    H lost_mass{};
    if (loads_act()) {
      const Outside<H> outside = loads(center);
      own.set(outside, center);
      force_B = outside.pull.force;
    }
    if (vehicle_.tanks_.flow()) {
      const Leaving<H> lost = leaving(center);
      own.power += lost.kinetic;
      own.torque_PntC_B += lost.H_PntC_B;
      force_B += lost.momentum - lost.mass * v_BC;
      lost_mass = lost.mass;
      if (falls()) books.power += lost_potential(center);
    }
    // What C does from B, and then B itself. Of mass that leaves, force_B has what C makes of it.
    const Vec<H> force_N = vehicle_.dcm_NB_ * force_B, all_N = force_N + lost_mass * v_BN_N;
    books.power += own.power - dot(force_B + (H(0.5) * lost_mass) * v_BC, v_BC) +
                   H(0.5) * dot(force_N + all_N, v_BN_N);
    books.force_N += all_N;
    return own;
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

  Outside<H> loads(const CenterMotion<H>& center) const {
    Outside<H> outside{vehicle_.held_};
    if (vehicle_.push_.acts()) outside.pull.add(vehicle_.pushed_);
    const Vec<H> r_CB = -center.r_BC;
    if (vehicle_.acts_at_center_) outside.pull.add(vehicle_.held_at_center_, r_CB);
    if (!vehicle_.acts_on_limbs_ && !vehicle_.push_.acts()) return outside;
    const Vec<S> r_CB_S = vehicle_.spread(r_CB);
    const Vec<S>* at = vehicle_.acts_at_center_ ? &r_CB_S : nullptr;
    outside +=
        of_limbs<Outside>([&](const auto& limb, Outside<S>& sum) { limb.add_loads(at, sum); });
    return outside;
  }

  Outside<H> gravity() const {
    const Field<S> field = vehicle_.spread(vehicle_.field_);
    Outside<H> outside =
        of_limbs<Outside>([&](const auto& limb, Outside<S>& sum) { limb.add_gravity(field, sum); });
    if (vehicle_.pulls_on_hub_) {
      outside.pull.add(vehicle_.pulled_hub_);
      outside.turn_power += dot(vehicle_.turned_hub_, omega_);
    }
    return outside;
  }

  Leaving<H> leaving(const CenterMotion<H>& center) const {
    const CenterMotion<S> center_S{vehicle_.spread(omega_), vehicle_.spread(center.r_BC),
                                   vehicle_.spread(center.w_BC)};
    Leaving<H> sum = of_limbs<Leaving>(
        [&](const auto& limb, Leaving<S>& of) { limb.add_leaving(center_S, of); });
    if (vehicle_.draining_.drains())
      sum.add(vehicle_.draining_.mass_rate(), omega_, center.r_BC, center.v_BC());
    return sum;
  }
  /// Beyond that of the same mass where B is and does not move.
  H lost_potential(const CenterMotion<H>& center) const {
    const Field<H>& field = vehicle_.field_;
    const Moment<H> lost = leaving_moment();
    H power = -(lost.mass * field.mu * root(field.inverse_r2));
    if (vehicle_.plan_.law == GravityLaw::kSystemCom)  // the field is that at C
      power -= dot(field.at_hub(), lost.moment + lost.mass * center.r_BC);
    if (!vehicle_.has_elements_) return power;
    const Field<S> field_S = vehicle_.spread(field);
    power += of_limbs<Power>([&](const auto& limb, Power<S>& sum) {
               limb.add_lifted(field_S, sum);
             }).power;
    for (std::size_t e = 0; e < vehicle_.elements_.size(); ++e)
      power += lifted(vehicle_.draining_.element_rate(e), vehicle_.elements_[e].r_EL, field);
    return power;
  }
  Moment<H> leaving_moment() const {
    Moment<H> sum =
        of_limbs<Moment>([](const auto& limb, Moment<S>& of) { limb.add_leaving_moment(of); });
    if (vehicle_.draining_.drains()) {
      const LinkMass<H>& rate = vehicle_.draining_.mass_rate();
      sum += {rate.mass, rate.moment};
    }
    return sum;
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
    return {total<kIsFull>(m.moment), total<kIsFull>(m.momentum), total<kIsFull>(m.inner_power)};
  }
  template <bool kIsFull>
  static Outside<H> total(const Outside<S>& o) {
    return {{total<kIsFull>(o.pull.force), total<kIsFull>(o.pull.torque)},
            total<kIsFull>(o.power),
            total<kIsFull>(o.turn_power)};
  }
  template <bool kIsFull>
  static Leaving<H> total(const Leaving<S>& o) {
    return {total<kIsFull>(o.mass), total<kIsFull>(o.momentum), total<kIsFull>(o.H_PntC_B),
            total<kIsFull>(o.kinetic)};
  }

  Vehicle<H, S>& vehicle_;
  const Number<H>* state_;
  Vec<H> omega_;
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
