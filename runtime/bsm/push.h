// The forces that follow the motion of links, at work in the kernel: see runtime/forces/list.h.
// Tested by tests/components/jet_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "runtime/bsm/limbs.h"
#include "runtime/forces/list.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

/// @tparam H, S  as of Vehicle
template <class H, class S>
requires KernelScalars<H, S>
class Push {
 public:
  /// @param limbs  learn to tell how they move, where there are such forces
  void build(std::span<const Plan* const> plans, Limbs<H, S>& limbs) {
    std::array<const Forces*, kLanes<H>> of{};
    for (std::size_t l = 0; l < kLanes<H>; ++l) of[l] = &plans[l]->forces;
    forces_ = ForceList<H>(of);
    const std::vector<int> links = links_of(plans[0]->forces);
    if (links.empty()) return;
    places_.resize(plans[0]->tree.links.size());
    limbs.for_each_place(*plans[0], [this](int link, const auto& place) {
      places_[static_cast<std::size_t>(link)] = place;
    });
    limbs.for_each([](auto& group) { group.limb.watch(); });
  }

  void hold(std::size_t l, const Plan& plan, const InputsIn<Number<H>>& inputs) {
    forces_.hold(l, plan.forces, inputs);
  }

  /// The vehicle has such forces.
  bool exists() const { return !places_.empty(); }
  /// One of them may do something until the next hold().
  bool acts() const { return forces_.acts(); }

  /// @param around  the hub's place, and its axes W  @param omega  of the hub
  /// @param limbs  have moved; each takes the pull on its links  @param on_hub  takes the hub's
  template <class OnHub>
  void add(const Surroundings<H>& around, const Vec<H>& omega, Limbs<H, S>& limbs,
           const OnHub& on_hub) const {
    LinkMotion<H> hub;
    hub.dcm_WL = {{H(1.0), H(0.0), H(0.0)}, {H(0.0), H(1.0), H(0.0)}, {H(0.0), H(0.0), H(1.0)}};
    hub.omega = omega;
    const auto motion_of = [&](int link) {
      LinkMotion<H> motion = hub;
      if (link > 0) {
        const auto& place = places_.data()[link];
        limbs.with(place,
                   [&](const auto& limb) { motion = limb.motion_of(place.link, place.lane); });
      }
      return motion;
    };
    forces_.add(around, motion_of, [&](int link, const Pull<H>& pull) {
      if (link == 0) return on_hub(pull);
      const auto& place = places_.data()[link];
      limbs.with(place, [&](auto& limb) { limb.push(place.link, place.lane, pull); });
    });
  }

 private:
  ForceList<H> forces_;
  std::vector<typename Limbs<H, S>::Place> places_;  // by link; empty: there are no such forces
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
