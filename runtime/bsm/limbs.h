// All limbs of a vehicle, like ones side by side in the lanes of S.
// Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "runtime/bsm/bob.h"
#include "runtime/bsm/chain_limb.h"
#include "runtime/bsm/limb_build.h"
#include "runtime/bsm/point.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

/// @tparam H, S  as of Vehicle
template <class H, class S>
requires KernelScalars<H, S>
class Limbs {
 public:
  using Plans = std::span<const Plan* const>;  // one per lane of H, alike

  template <class Of>
  struct Group {
    std::array<std::size_t, kLimbs<H, S>> limbs;  // of the plan
    bool is_full;  // else the second lane repeats the first one's limb
    Of limb;
  };
  /// Where the rows of as many particles begin as the books take at once, see Particle.
  using Particles = std::array<const Number<S>*, kLimbs<H, S> == 1 ? 1 : kLanes<Abreast>>;

  Limbs() = default;
  Limbs(const Limbs&) = delete;  // particles_ tells where limbs are
  Limbs& operator=(const Limbs&) = delete;

  void build(Plans plans, const Layout& layout) {
    const std::vector<LimbPlan>& all = plans[0]->limbs;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if constexpr (kLimbs<H, S> == 1) {
        add({k}, true, plans, layout);
      } else {
        if (is_grouped(k)) continue;
        std::size_t other = k + 1;
        while (other < all.size() &&
               (is_grouped(other) || !are_alike(all.data()[k], all.data()[other])))
          ++other;
        const bool alone = other == all.size();
        add({k, alone ? k : other}, !alone, plans, layout);
      }
    }
    tell_particles();
  }

  template <class Each>
  void for_each(const Each& each) {
    for_each_particle(each);
    for_each_tree(each);
  }
  template <class Each>
  void for_each(const Each& each) const {
    for_each_particle(each);
    for_each_tree(each);
  }
  template <class Each>
  void for_each_particle(const Each& each) {
    for (auto& group : points_) each(group);
    for (auto& group : bobs_) each(group);
  }
  template <class Each>
  void for_each_particle(const Each& each) const {
    for (const auto& group : points_) each(group);
    for (const auto& group : bobs_) each(group);
  }
  template <class Each>
  void for_each_tree(const Each& each) {
    for (auto& group : chains_) each(group);
    for (auto& group : trees_) each(group);
  }
  template <class Each>
  void for_each_tree(const Each& each) const {
    for (const auto& group : chains_) each(group);
    for (const auto& group : trees_) each(group);
  }
  std::span<const Particles> particles() const { return particles_; }
  bool has_particles() const { return !points_.empty() || !bobs_.empty(); }
  /// The limb in lane l of S.
  template <class Of>
  static const LimbPlan& plan_of(const Group<Of>& group, std::size_t l, const Plan& plan) {
    return plan.limbs.data()[group.limbs[l % kLimbs<H, S>]];
  }

  /// Where a link is among them.
  struct Place {
    bool is_point = false;
    std::size_t group = 0, link = 0, lane = 0;
  };
  /// But of bobs and chains, which no force that follows their motion acts on.
  /// @param at  takes a link of the plan and its place
  template <class At>
  void for_each_place(const Plan& plan, const At& at) const {
    tell_places(points_, true, plan, at);
    tell_places(trees_, false, plan, at);
  }
  /// @param each  takes the Point or Limb at a place
  template <class Each>
  void with(const Place& place, const Each& each) {
    if (place.is_point)
      each(points_.data()[place.group].limb);
    else
      each(trees_.data()[place.group].limb);
  }

 private:
  void add(const std::array<std::size_t, kLimbs<H, S>>& limbs, bool is_full, Plans plans,
           const Layout& layout) {
    std::array<const LimbPlan*, kLanes<S>> of_lanes;
    std::array<const Plan*, kLanes<S>> plan_of_lanes;
    for (std::size_t l = 0; l < kLanes<S>; ++l) {
      plan_of_lanes[l] = plans[l / kLimbs<H, S>];
      of_lanes[l] = &plan_of_lanes[l]->limbs.data()[limbs[l % kLimbs<H, S>]];
    }
    switch (of_lanes[0]->kind) {
      case LimbKind::kPoint:
        points_.push_back({limbs, is_full, Point<H, S>(of_lanes, plan_of_lanes, is_full, layout)});
        return;
      case LimbKind::kBob:
        bobs_.push_back({limbs, is_full, Bob<H, S>(of_lanes, plan_of_lanes, is_full, layout)});
        return;
      case LimbKind::kChain:
        chains_.push_back({limbs, is_full, ChainLimb<H, S>(of_lanes, layout)});
        return;
      case LimbKind::kTree:
        trees_.push_back({limbs, is_full, Limb<H, S>(of_lanes, plan_of_lanes, layout)});
        return;
    }
  }

  void tell_particles() {
    static const std::array<Number<S>, Particle<H, S>::kRows * kLanes<S>> kNothing{};
    std::size_t used = 0;  // of the last
    const auto add = [&](const Number<S>* rows) {
      if (rows == nullptr) return;
      if (used % std::tuple_size_v<Particles> == 0) {
        particles_.emplace_back().fill(kNothing.data());
        used = 0;
      }
      particles_.back()[used++] = rows;
    };
    for_each_particle([&](const auto& group) {
      for (std::size_t j = 0; j < kLimbs<H, S>; ++j) add(group.limb.rows(j));
    });
  }

  bool is_grouped(std::size_t k) const {
    bool found = false;
    for_each([&found, k](const auto& group) {
      for (const std::size_t limb : group.limbs) found = found || limb == k;
    });
    return found;
  }

  template <class Of, class At>
  static void tell_places(const std::vector<Group<Of>>& groups, bool is_point, const Plan& plan,
                          const At& at) {
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (std::size_t j = 0; j < kLimbs<H, S>; ++j) {
        if (j > 0 && !groups[g].is_full) continue;
        const LimbPlan& limb = plan.limbs.data()[groups[g].limbs[j]];
        for (std::size_t i = 0; i < limb.links.size(); ++i)
          at(limb.links[i].link, Place{is_point, g, i, j});
      }
  }

  std::vector<Group<Point<H, S>>> points_;
  std::vector<Group<Bob<H, S>>> bobs_;
  std::vector<Group<ChainLimb<H, S>>> chains_;
  std::vector<Group<Limb<H, S>>> trees_;
  std::vector<Particles> particles_;
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
