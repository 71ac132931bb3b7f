// What point masses on joints of the hub have in common, however they are joined to it: a place and
// a velocity in hub axes, and a mass that may drain. A lane that no particle is in weighs nothing,
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
  Vec<S> momentum() const { return mass_ * v_; }
  Outside<S> gravity(const Field<S>& field) const {
    Outside<S> outside;
    outside.add_at(mass_ * field.difference(r_), r_, v_);
    return outside;
  }
  Leaving<S> leaving(const Field<S>* field) const {
    Leaving<S> leaving;
    if (!draining_.drains()) return leaving;
    const S& rate = draining_.mass_rate().mass;
    leaving.add_point(rate, r_, v_);
    if (field != nullptr) leaving.lift(rate, r_, *field);
    return leaving;
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
  Vec<S> r_, v_;  // [m], [m/s] from B, whose velocity is left out

 private:
  S idle_{};  // [kg] what stands for the mass of nothing, which is divided by
  LinkDrain<H, S> draining_;
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
