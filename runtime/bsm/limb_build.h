// How a limb is made of its plan. Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include "runtime/bsm/limb.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

/// Such as the first of a pendulum's two links.
inline bool has_no_mass(const bsm::LinkConstants& link) {
  bool all_zero = link.mass == 0.0 && !link.drains;
  for (std::size_t i = 0; i < 3; ++i) all_zero = all_zero && link.first_moment.data()[i] == 0.0;
  for (std::size_t i = 0; i < 9; ++i) all_zero = all_zero && link.J_L.data()[i] == 0.0;
  return all_zero;
}

template <class H, class S>
requires KernelScalars<H, S>
inline Limb<H, S>::Limb(Lanes lanes, Plans plans, const Layout& layout) {
  const LimbPlan& first = *lanes.front();
  links_.resize(first.links.size());
  motions_.resize(first.links.size());
  laws_.resize(first.links.size());
  recoveries_.resize(first.links.size());
  for (std::size_t l = 0; l < lanes.size(); ++l) set(l, *lanes[l], *plans[l], layout);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (!links_[i].slides) hinges_.push_back(i);
    LinkDrain<H, S> drain;
    for (std::size_t l = 0; l < lanes.size(); ++l) drain.set(l, *plans[l], lanes[l]->links[i]);
    drain.turn(links_[i].dcm_KL);
    if (drain.drains()) draining_.push_back({i, drain});
  }
  for (std::size_t c = 0; c < first.chains.size(); ++c) {
    std::array<const ChainPlan*, kLanes<S>> of_lanes;
    for (std::size_t l = 0; l < lanes.size(); ++l) of_lanes[l] = &lanes[l]->chains[c];
    Chain<H, S>& chain = chains_.emplace_back(of_lanes, layout);
    chain.turn_mount(links_[index(chain.mount())].dcm_KL);
  }
  turn_links();
  find_first_to_tell();
}

template <class H, class S>
requires KernelScalars<H, S>
inline void Limb<H, S>::set(std::size_t l, const LimbPlan& limb, const Plan& plan,
                            const Layout& layout) {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const LinkPlan& from = limb.links[i];
    const bsm::LinkConstants& constants = plan.tree.links[index(from.link)];
    Link& link = links_[i];
    link.parent = from.parent;
    link.slides = constants.kind == JointKind::kSlide;
    link.damped_by_cosine_of = from.damped_by_cosine_of;
    set_lane(link.dcm_KL, l, constants.dcm_KL);
    set_lane(link.dcm_PK0, l, constants.dcm_PK0);
    set_lane(link.r_HP_P, l, constants.r_HP_P);
    set_lane(link.stiffness, l, constants.stiffness);
    set_lane(link.damping, l, constants.damping);
    set_lane(link.rest, l, constants.rest);
    link.mass.set(l, constants);
    link.is_massless = link.is_massless && has_no_mass(constants) && from.rotors.empty();
    link.position[l % kLimbs<H, S>] = layout.position(from.link);
    link.rate[l % kLimbs<H, S>] = layout.rate(from.link);
    if (l == 0) {
      link.elements.resize(from.elements.size());
      link.rotors.resize(from.rotors.size());
    }
    for (std::size_t e = 0; e < from.elements.size(); ++e)
      link.elements[e].set(l, from.elements[e]);
    for (std::size_t k = 0; k < from.rotors.size(); ++k) {
      link.rotors[k].set(l, plan.tree.rotors[index(from.rotors[k])], layout.wheel + from.rotors[k]);
    }
  }
}

/// From their axes L into K.
template <class H, class S>
requires KernelScalars<H, S>
inline void Limb<H, S>::turn_links() {
  for (Link& link : links_) {
    link.mass.turn(link.dcm_KL);
    for (ElementNow<S>& element : link.elements) element.turn(link.dcm_KL);
    for (RotorOn<H, S>& rotor : link.rotors) rotor.axis_L = link.dcm_KL * rotor.axis_L;
    if (link.parent < 0) continue;
    const Mat<S>& dcm = links_[index(link.parent)].dcm_KL;
    link.r_HP_P = dcm * link.r_HP_P;
    link.dcm_PK0 = dcm * link.dcm_PK0;
  }
}

/// contribute() goes through chains, then through links from the last to the first.
template <class H, class S>
requires KernelScalars<H, S>
inline void Limb<H, S>::find_first_to_tell() {
  for (std::size_t i = 1; i < links_.size(); ++i) {
    bool& first = links_[i].tells_first;
    const int parent = links_[i].parent;
    for (const Chain<H, S>& chain : chains_) first = first && chain.mount() != parent;
    for (std::size_t j = i + 1; j < links_.size(); ++j) first = first && links_[j].parent != parent;
  }
}

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
