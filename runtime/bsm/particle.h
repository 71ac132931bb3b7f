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
  /// What the books read, in a row for every lane: they take particles by other lanes than these.
  struct Now {
    S mass{}, mass_rate{};  // [kg], [kg/s]
    Vec<S> r, w;            // [m], [m/s] from B, seen from the hub's axes
  };
  enum Row : std::uint8_t {
    kMass,
    kMassRate,
    kPlace,
    kVelocity = kPlace + 3,
    kRows = kVelocity + 3
  };
  static_assert(sizeof(Now) == kRows * sizeof(S));

  /// As of Limb.
  void flow(const Tanks<H>& tanks) {
    draining_.flow(tanks);
    now_.mass_rate = draining_.mass_rate().mass;
  }
  void drain(const Tanks<H>& tanks) {
    if (draining_.drains()) put_mass(draining_.point_mass(tanks));
  }
  Moment<S> moment() const { return {now_.mass, now_.mass * now_.r}; }
  /// Nothing where lane l is idle.
  const Number<S>* rows(std::size_t l) const {
    return is_idle(l) ? nullptr : reinterpret_cast<const Number<S>*>(&now_) + l;
  }

 protected:
  /// In lane l.
  void set_mass(std::size_t l, const Plan& plan, const LinkPlan& link) {
    set_lane(now_.mass, l, plan.tree.links.data()[link.link].mass);
    draining_.set(l, plan, link);
  }
  void set_idle(std::size_t l) { set_lane(idle_, l, 1.0); }
  bool is_idle(std::size_t l) const { return !vanishes(lane(idle_, l)); }
  /// After all lanes.
  void put_mass(const S& mass) {
    now_.mass = mass;
    inverse_mass_ = S(1.0) / (mass + idle_);
  }

  Now now_;
  S inverse_mass_{};

 private:
  S idle_{};  // [kg] what stands for the mass of nothing, which is divided by
  LinkDrain<H, S> draining_;
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
