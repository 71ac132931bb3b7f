// What point masses on joints of the hub have in common, however they are joined to it: a place and
// a velocity in the hub, and a mass that may drain. A lane that no particle is in weighs nothing,
// so that what the lanes say can be added up as it is.
// Tested by tests/runtime/bsm_test.cpp and tests/runtime/books_test.cpp.
#pragma once

#include "runtime/bsm/draining.h"
#include "runtime/bsm/law.h"
#include "runtime/bsm/outside.h"
#include "runtime/bsm/parts.h"
#include "runtime/bsm/plan.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

template <class H, class S>
requires KernelScalars<H, S>
class Particle {
 public:
  /// As of Limb.
  void flow(const Tanks<H>& tanks) { draining_.flow(tanks); }
  void drain(const Tanks<H>& tanks) {
    if (draining_.drains()) put_mass(draining_.point_mass(tanks));
  }
  Moment<S> moment() const { return {mass_, mass_ * r_}; }

  // For the books, as of Limb.
  void add_motion(MassMotion<S>& sum) const { sum.add_at(mass_, r_, w_); }
  void add_gravity(const Field<S>& field, Outside<S>& sum) const {
    sum.add_at(mass_ * field.difference(r_), r_, w_);
  }
  void add_leaving(const CenterMotion<S>& center, Leaving<S>& sum) const {
    if (!draining_.drains()) return;
    const Vec<S> r = r_ + center.r_BC;
    sum.add_point(draining_.mass_rate().mass, r, plus_cross(w_ + center.w_BC, center.omega, r));
  }
  void add_leaving_moment(Moment<S>& sum) const {
    const S& rate = draining_.mass_rate().mass;
    sum += {rate, rate * r_};
  }
  void add_lifted(const Field<S>& field, Power<S>& sum) const {
    if (draining_.drains()) sum.power += lifted(draining_.mass_rate().mass, r_, field);
  }

 protected:
  /// In lane l.
  void set_mass(std::size_t l, const Plan& plan, const LinkPlan& link) {
    set_lane(mass_, l, plan.tree.links.data()[link.link].mass);
    draining_.set(l, plan, link);
  }
  void set_idle(std::size_t l) { set_lane(idle_, l, 1.0); }
  bool is_idle(std::size_t l) const { return !vanishes(lane(idle_, l)); }
  /// After all lanes.
  void put_mass(const S& mass) {
    mass_ = mass;
    inverse_mass_ = S(1.0) / (mass_ + idle_);
  }

  S mass_{}, inverse_mass_{};
  Vec<S> r_, w_;  // [m], [m/s] from B, seen from the hub's axes

 private:
  S idle_{};  // [kg] what stands for the mass of nothing, which is divided by
  LinkDrain<H, S> draining_;
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
