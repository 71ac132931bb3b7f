// What a limb says to the books, from what an evaluation left in memory.
// Tested by tests/runtime/books_test.cpp.
#pragma once

#include "runtime/bsm/limb.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

template <class H, class S>
requires KernelScalars<H, S>
auto Limb<H, S>::inner_power(const Number<H>* state) const -> S {
  S power(0.0);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    const S& q_dot = motions_[i].q_dot;
    power += (link.effort - damping(link) * q_dot) * q_dot;
    for (const RotorOn<H, S>& rotor : link.rotors) power += rotor.power(state);
  }
  for (const Chain<H, S>& chain : chains_) power += chain.inner_power(state);
  return power;
}

template <class H, class S>
requires KernelScalars<H, S>
void Limb<H, S>::add_motion(MassMotion<S>& sum) const {
  MassMotion<S> own;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Motion& m = motions_[i];
    own.add_at(links_[i].mass.mass, m.at.r_LB, m.at.v_LB);
    own.moment.moment += m.moment;
    own.momentum += cross(m.at.omega, m.moment);
  }
  for (const Chain<H, S>& chain : chains_) {
    MassMotion<S> of_chain = chain.motion();
    of_chain.carry(mount(chain.mount()));
    own += of_chain;
  }
  own.momentum -= cross(hub_.omega, own.moment.moment);
  sum += own;
}

template <class H, class S>
requires KernelScalars<H, S>
void Limb<H, S>::add_loads(const Vec<S>* r_CB, Outside<S>& sum) const {
  Outside<S> own;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const MountMotion<S>& at = motions_[i].at;
    const Mat<S> dcm = dcm_WL(i);
    Pull<S> pull{dcm * links_[i].held.force, dcm * links_[i].held.torque};
    if (is_watched_) pull.add(motions_[i].pushed);
    if (r_CB != nullptr) pull.add(dcm * links_[i].held_at_center, *r_CB - at.r_LB);
    own.add(pull, at);
  }
  add_seen_from_hub(own, sum);
}

template <class H, class S>
requires KernelScalars<H, S>
void Limb<H, S>::add_gravity(const Field<S>& field, Outside<S>& sum) const {
  Outside<S> own;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const MountMotion<S>& at = motions_[i].at;
    for (const ElementNow<S>& element : links_[i].elements) {
      const Vec<S> r_EL = at.dcm_WL * element.r_EL;
      const Vec<S> place = at.r_LB + r_EL;
      Pull<S> pull;
      pull.add(element.mass * field.difference(place), r_EL);
      own.add(pull, at);
      if (field.has_gradient)
        own.add_turn(field.gradient_torque(place, element.I.turned(at.dcm_WL)), at.omega);
    }
  }
  for (const Chain<H, S>& chain : chains_) {
    Outside<S> on_chain = chain.gravity();
    on_chain.carry(mount(chain.mount()));
    own += on_chain;
  }
  add_seen_from_hub(own, sum);
}

template <class H, class S>
requires KernelScalars<H, S>
void Limb<H, S>::add_leaving(Leaving<S>& sum) const {
  for (const DrainingLink& draining : draining_)
    sum.add(draining.drain.mass_rate(), motions_[draining.link].at);
}

template <class H, class S>
requires KernelScalars<H, S>
void Limb<H, S>::add_lifted(const Field<S>& field, Power<S>& sum) const {
  for (const DrainingLink& draining : draining_) {
    const MountMotion<S>& at = motions_[draining.link].at;
    const std::vector<ElementNow<S>>& elements = links_[draining.link].elements;
    for (std::size_t e = 0; e < elements.size(); ++e)
      sum.power +=
          lifted(draining.drain.element_rate(e), at.r_LB + at.dcm_WL * elements[e].r_EL, field);
  }
}

template <class H, class S>
requires KernelScalars<H, S>
void Limb<H, S>::add_seen_from_hub(Outside<S>& own, Outside<S>& sum) const {
  own.power -= dot(hub_.omega, own.pull.torque);
  sum += own;
}

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
