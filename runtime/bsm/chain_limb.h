// A limb that is one chain on the hub, such as a solar array. Nothing in a chain drains, is pushed
// or has something held on it.  Tested by tests/runtime/bsm_test.cpp (against the general limb and
// the dense oracle).
#pragma once

#include <span>

#include "runtime/bsm/chain.h"
#include "runtime/bsm/draining.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

template <class H, class S>
requires KernelScalars<H, S>
class ChainLimb {
 public:
  /// @param lanes  one per lane of S, alike
  ChainLimb(std::span<const LimbPlan* const> lanes, const Layout& layout)
      : chain_(chains_of(lanes), layout) {}

  // As of Limb.
  void flow(const Tanks<H>&) {}
  void drain(const Tanks<H>&) {}
  void hold(std::size_t l, const LimbPlan& limb, const HeldInputsIn<Number<H>>& held) {
    chain_.hold(l, *limb.chains.data(), held);
  }
  void watch() {}
  void move(const Number<H>* state, const Vec<S>& omega_BN_B) {
    hub_.omega = omega_BN_B;
    chain_.move(state, hub_);
  }
  Moment<S> moment() const { return chain_.moment(); }
  const Law<S>& contribute(const Field<S>* field, const Vec<S>*) {
    chain_.template tell<true>(field, law_);
    return law_;
  }
  void recover(const Vec<S>& omega_dot_B, const Vec<S>& a_B, Number<H>* rate) const {
    chain_.recover(omega_dot_B, a_B, rate);
  }

  // For the books, as of Limb.
  S inner_power(const Number<H>* state) const { return chain_.inner_power(state); }
  void trace(const Number<H>*) {}
  void add_motion(MassMotion<S>& sum) const { sum += chain_.motion(); }
  void add_loads(const Vec<S>*, Outside<S>&) const {}
  void add_gravity(const Field<S>&, Outside<S>& sum) const { sum += chain_.gravity(); }
  void add_leaving(Leaving<S>&) const {}
  void add_lifted(const Field<S>&, Power<S>&) const {}

 private:
  static std::array<const ChainPlan*, kLanes<S>> chains_of(std::span<const LimbPlan* const> lanes) {
    std::array<const ChainPlan*, kLanes<S>> chains;
    for (std::size_t l = 0; l < lanes.size(); ++l) chains[l] = lanes[l]->chains.data();
    return chains;
  }

  Chain<H, S> chain_;
  MountMotion<S> hub_ = hub_itself<S>();
  Law<S> law_;
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
