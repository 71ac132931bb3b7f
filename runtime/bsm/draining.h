// What follows the tanks inside the kernel: their shares at the time of a stage, and the masses
// that these scale. Every stage finds them anew, from what it was given to hold and its time alone.
// Tested by tests/runtime/kernel_test.cpp and tests/components/depletion_test.cpp.
#pragma once

#include <vector>

#include "runtime/bsm/parts.h"
#include "runtime/bsm/plan.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

/// The tanks of a spacecraft, or of one per lane: see Drain.
template <KernelScalar H>
class Tanks {
 public:
  /// @param count  how many; one more, at the end, is always full: what drains with no tank
  explicit Tanks(std::size_t count) : tanks_(count + 1) {}

  void hold(std::size_t l, const InputsIn<Number<H>>& inputs) {
    if (l == 0) flow_ = false;
    for (std::size_t k = 0; k + 1 < tanks_.size(); ++k) {
      const auto& from = inputs.tanks.data()[k];
      Tank& tank = tanks_[k];
      set_lane(tank.full, l, from.full);
      set_lane(tank.spent, l, from.spent);
      set_lane(tank.since, l, from.since);
      set_lane(tank.flow, l, from.flow);
      set_lane(tank.share_rate, l, -from.flow / from.full);
      flow_ = flow_ || !vanishes(from.flow);
    }
  }
  /// Their shares change until the next hold().
  bool flow() const { return flow_; }

  void move_to(const H& time) {
    for (Tank& tank : tanks_) tank.share = tank.share_at(time);
  }
  /// What is left at the time of the last move_to(), as a part of what there was at t = 0.
  template <class S>
  S share(const Places<H, S>& tanks) const {
    if constexpr (kLimbs<H, S> == 1) {
      return tanks_[index(tanks[0])].share;
    } else {
      return from_lanes<S>([&](std::size_t l) { return tanks_[index(tanks[l])].share; });
    }
  }
  /// How fast that changes under the held flow [1/s].
  template <class S>
  S share_rate(const Places<H, S>& tanks) const {
    if constexpr (kLimbs<H, S> == 1) {
      return tanks_[index(tanks[0])].share_rate;
    } else {
      return from_lanes<S>([&](std::size_t l) { return tanks_[index(tanks[l])].share_rate; });
    }
  }

 private:
  struct Tank {
    H full = H(1.0), spent{}, since{}, flow{};
    H share = H(1.0), share_rate{};

    /// In the order of Drain::share.
    H share_at(const H& time) const {
      const H passed = time - since, nothing(0.0);
      return (full - (spent + flow * chosen(passed > nothing, passed, nothing))) / full;
    }
  };
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  std::vector<Tank> tanks_;
  bool flow_ = false;
};

/// The mass of a link.
template <KernelScalar S>
struct LinkMass {
  S mass{};
  Vec<S> moment;  // [kg m] mass times the centre of mass from the link's origin, link axes
  Sym<S> J;       // [kg m^2] about the origin, without the axial inertia of rotors

  /// Of LinkConstants or MassSums.
  void set(std::size_t l, const auto& from) {
    set_lane(mass, l, from.mass);
    set_lane(moment, l, from.first_moment);
    set_lane(J.xx, l, from.J_L(0, 0));
    set_lane(J.yy, l, from.J_L(1, 1));
    set_lane(J.zz, l, from.J_L(2, 2));
    set_lane(J.xy, l, from.J_L(1, 0));
    set_lane(J.xz, l, from.J_L(2, 0));
    set_lane(J.yz, l, from.J_L(2, 1));
  }
  /// Into other axes.
  void turn(const Mat<S>& dcm) {
    moment = dcm * moment;
    J = J.turned(dcm);
  }
  void add(const S& share, const LinkMass& part) {
    mass += share * part.mass;
    moment += share * part.moment;
    J += share * part.J;
  }
};

/// How the mass of a link, and of its elements, follows the tanks: see Draining. Of like links
/// that share lanes one may drain and the other not.
template <class H, class S>
requires KernelScalars<H, S>
class LinkDrain {
 public:
  void set(std::size_t l, const Plan& plan, const LinkPlan& link) {
    const auto i = static_cast<std::size_t>(link.link);
    const int no_tank = static_cast<int>(plan.tree.tanks);
    const Draining* draining = plan.tree.draining_of(i);
    if (draining == nullptr) {
      fixed_.set(l, plan.tree.links.data()[i]);
    } else {
      fixed_.set(l, draining->fixed);
      for (std::size_t k = 0; k < draining->parts.size(); ++k) {
        if (k == parts_.size()) parts_.push_back({all(no_tank), {}});
        const Draining::Part& from = draining->parts.data()[k];
        parts_[k].tank[l % kLimbs<H, S>] = static_cast<int>(from.tank);
        parts_[k].full.set(l, from.full);
      }
    }
    if (l == 0) {
      elements_.resize(link.elements.size());
      element_rates_.resize(link.elements.size());
    }
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      const MassElement& from = link.elements.data()[e];
      elements_[e].tank[l % kLimbs<H, S>] = from.tank < 0 ? no_tank : from.tank;
      elements_[e].full.set(l, from);
    }
  }

  /// Into other axes than the link's own.
  void turn(const Mat<S>& dcm) {
    fixed_.turn(dcm);
    for (auto& part : parts_) part.full.turn(dcm);
    for (auto& part : elements_) part.full.turn(dcm);
  }

  /// In some lane.
  bool drains() const { return !parts_.empty(); }

  LinkMass<S> mass(const Tanks<H>& tanks) const {
    LinkMass<S> sums = fixed_;
    for (const auto& part : parts_) sums.add(tanks.template share<S>(part.tank), part.full);
    return sums;
  }
  /// Of it the mass alone [kg].
  S point_mass(const Tanks<H>& tanks) const {
    S sum = fixed_.mass;
    for (const auto& part : parts_) sum += tanks.template share<S>(part.tank) * part.full.mass;
    return sum;
  }
  /// Once per hold(): the rates below, which then stay.
  void flow(const Tanks<H>& tanks) {
    mass_rate_ = {};
    for (const auto& part : parts_)
      mass_rate_.add(tanks.template share_rate<S>(part.tank), part.full);
    for (std::size_t e = 0; e < elements_.size(); ++e)
      element_rates_[e] = tanks.template share_rate<S>(elements_[e].tank) * elements_[e].full.mass;
  }
  /// How fast mass() changes [kg/s], [kg m/s], [kg m^2/s].
  const LinkMass<S>& mass_rate() const { return mass_rate_; }
  /// How fast an element loses mass [kg/s].
  const S& element_rate(std::size_t e) const { return element_rates_[e]; }
  /// @param elements  those of the link
  void put_elements(const Tanks<H>& tanks, std::vector<ElementNow<S>>& elements) const {
    for (std::size_t e = 0; e < elements.size(); ++e) {
      elements[e].keep(tanks.template share<S>(elements_[e].tank), elements_[e].full);
    }
  }

 private:
  template <class Of>
  struct Part {
    Places<H, S> tank{};
    Of full;
  };
  static Places<H, S> all(int tank) {
    Places<H, S> places;
    for (int& place : places) place = tank;
    return places;
  }

  LinkMass<S> fixed_;
  std::vector<Part<LinkMass<S>>> parts_;
  std::vector<Part<ElementNow<S>>> elements_;
  LinkMass<S> mass_rate_;
  std::vector<S> element_rates_;
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
