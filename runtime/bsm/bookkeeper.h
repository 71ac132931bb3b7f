// What a vehicle's evaluation leaves to its books, from what is in memory after it: summed over hub
// and limbs as their laws are, without a second motion of the tree.
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
      : vehicle_(vehicle), particles_(vehicle.limbs_), state_(state) {}

  /// All that changes the books, where BookCauses::are_inner().
  H inner_power() const {
    return with_rotors(of_limbs<Power>([&](const auto& limb, Power<S>& sum) {
                         sum.power += limb.inner_power(state_);
                       }).power);
  }

  /// Lets limbs know their velocities.
  void write(BookPage<H>& page) {
    const BookCauses& causes = vehicle_.book_causes();
    page.omega = vehicle_.vector(state_, vehicle_.layout_.omega);
    if (causes.drive && !causes.flow) page.leaving = page.driving = page.turning = {};
    write_particles(causes, page);
    write_trees(causes, page);
    add(vehicle_.mass_.mass, vehicle_.mass_.moment, page.mass);
    page.motion.value = with_rotors(page.motion.value);
    if (causes.fall) page.fall = fall();
    if (causes.drive) write_driving(causes, page);
    if (causes.pull) write_pulls(page);
    if (!vehicle_.turns_alone_)
      page.dcm_NB = vehicle_.dcm_NB_;
    else if (causes.drive)
      page.dcm_NB = attitude();
  }

 private:
  H with_rotors(H power) const {
    for (const RotorOn<H, H>& rotor : vehicle_.rotors_) power += rotor.power(state_);
    return power;
  }

  void write_particles(const BookCauses& causes, BookPage<H>& page) {
    Power<S> power{};
    vehicle_.limbs_.for_each_particle([&](auto& group) {
      power.power += group.limb.inner_power(state_);
      group.limb.trace(state_);
    });
    if (causes.flow)
      particles_.put_motion_and_leaving(page);
    else
      particles_.put_motion(page);
    page.motion.value += total<true>(power).power;
  }
  void write_trees(const BookCauses& causes, BookPage<H>& page) {
    for_each_tree<MassMotion>(
        [&](auto& limb, MassMotion<S>& sum) {
          sum.inner_power += limb.inner_power(state_);
          limb.trace(state_);
          limb.add_motion(sum);
        },
        [&page](const MassMotion<S>& sum, auto is_full) {
          gather<is_full>(sum.moment.mass, sum.moment.moment, page.mass);
          gather<is_full>(sum.inner_power, sum.momentum, page.motion);
        });
    if (!causes.flow) return;
    for_each_tree<Leaving>([](const auto& limb, Leaving<S>& sum) { limb.add_leaving(sum); },
                           [&page](const Leaving<S>& sum, auto is_full) {
                             gather<is_full>(sum.moment.mass, sum.moment.moment, page.leaving);
                             gather<is_full>(sum.power, sum.pull.force, page.driving);
                             gather<is_full>(S(0.0), sum.pull.torque, page.turning);
                           });
  }
  void write_driving(const BookCauses& causes, BookPage<H>& page) const {
    page.v_BN_N = vehicle_.vector(state_, 3);
    if (vehicle_.acts_beyond_hub_) {
      const Outside<H> loads = loads_beyond_hub(page);
      add(loads.power + dot(page.omega, loads.pull.torque), loads.pull.force, page.driving);
      page.turning.vector += loads.pull.torque;
    }
    if (causes.flow && causes.fall) write_lost_potential(page);
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

  Outside<H> loads_beyond_hub(const BookPage<H>& page) const {
    Outside<H> outside;
    if (vehicle_.push_.acts()) outside.pull.add(vehicle_.pushed_);
    const Vec<H> r_CB = (H(1.0) / page.mass.value) * page.mass.vector;
    if (vehicle_.acts_at_center_) outside.pull.add(vehicle_.held_at_center_, r_CB);
    const Vec<S> r_CB_S = spread<S>(r_CB);
    const Vec<S>* at = vehicle_.acts_at_center_ ? &r_CB_S : nullptr;
    outside +=
        of_limbs<Outside>([&](const auto& limb, Outside<S>& sum) { limb.add_loads(at, sum); });
    return outside;
  }

  /// Differences from that at B.
  void write_pulls(BookPage<H>& page) const {
    particles_.put_pulls(vehicle_.field_, page);
    const Field<S> field = spread<S>(vehicle_.field_);
    for_each_tree<Outside>([&](const auto& limb, Outside<S>& sum) { limb.add_gravity(field, sum); },
                           [&page](const Outside<S>& sum, auto is_full) {
                             gather<is_full>(sum.power, sum.pull.force, page.pulls);
                             gather<is_full>(sum.turn_power, sum.pull.torque, page.twists);
                           });
    if (!vehicle_.pulls_on_hub_) return;
    page.pulls.vector += vehicle_.pulled_hub_.force;
    add(dot(vehicle_.turned_hub_, page.omega), vehicle_.pulled_hub_.torque, page.twists);
  }

  /// Of mass that leaves, beyond that of the same mass where B is and does not move.
  void write_lost_potential(BookPage<H>& page) const {
    const Field<H>& field = vehicle_.field_;
    const LinkMass<H>& of_hub = vehicle_.draining_.mass_rate();
    const H lost = page.leaving.value + of_hub.mass;
    H& power = page.turning.value;
    power -= lost * field.mu * root(field.inverse_r2);
    if (vehicle_.plan_.law == GravityLaw::kSystemCom) {  // the field is that at C
      const Vec<H> r_CB = (H(1.0) / page.mass.value) * page.mass.vector;
      power -= dot(field.at_hub(), page.leaving.vector + of_hub.moment - lost * r_CB);
    }
    if (!vehicle_.has_elements_) return;
    power += particles_.lift(field);
    const Field<S> field_S = spread<S>(field);
    for_each_tree<Power>(
        [&](const auto& limb, Power<S>& sum) { limb.add_lifted(field_S, sum); },
        [&power](const Power<S>& sum, auto is_full) { power += total<is_full>(sum).power; });
    for (std::size_t e = 0; e < vehicle_.elements_.size(); ++e)
      power += lifted(vehicle_.draining_.element_rate(e), vehicle_.elements_[e].r_EL, field);
  }

  static void add(const H& value, const Vec<H>& vector, Four<H>& to) {
    to.value += value;
    to.vector += vector;
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
    for_each_tree<Sum>(add,
                       [&all](const Sum<S>& sum, auto is_full) { all += total<is_full>(sum); });
    return all;
  }
  /// But of particles. @param take  takes what like ones say, and whether all their lanes count
  template <template <class> class Sum, class Add, class Take>
  void for_each_tree(const Add& add, const Take& take) const {
    vehicle_.limbs_.for_each_tree([&](auto& group) {
      Sum<S> limbs{};
      add(group.limb, limbs);
      group.is_full ? take(limbs, std::true_type()) : take(limbs, std::false_type());
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
  static Power<H> total(const Power<S>& p) {
    return {total<kIsFull>(p.power)};
  }
  template <bool kIsFull>
  static Outside<H> total(const Outside<S>& o) {
    return {{total<kIsFull>(o.pull.force), total<kIsFull>(o.pull.torque)},
            total<kIsFull>(o.power),
            total<kIsFull>(o.turn_power)};
  }
  template <bool kIsFull>
  static void gather(const S& value, const Vec<S>& v, Four<H>& to) {
    add_two_gathered<kIsFull>(&to.value, value, v.x);
    add_two_gathered<kIsFull>(&to.vector.y, v.y, v.z);
  }

  Vehicle<H, S>& vehicle_;
  ParticleBooks<H, S> particles_;
  const Number<H>* state_;
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
