// A point mass on a slide in the hub, such as a slosh particle: the recursion's one step for it,
// written out. With e = r x s,
//   M = m (1 - s s^T),  H = m (r~ - e s^T),  J = m (r^2 1 - r r^T - e e^T)
// are what is left about B when the slide along s has taken its own acceleration out.
// Tested by tests/runtime/bsm_test.cpp (against the general limb and the dense oracle).
#pragma once

#include <span>

#include "runtime/bsm/particle.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

template <class H, class S>
requires KernelScalars<H, S>
class Point : public Particle<H, S> {
 public:
  using Lanes = std::span<const LimbPlan* const>;  // one per lane of S, alike
  using Plans = std::span<const Plan* const>;      // whose limbs they are

  /// @param is_full  else lanes of a second limb are idle
  Point(Lanes lanes, Plans plans, bool is_full, const Layout& layout) {
    for (std::size_t l = 0; l < lanes.size(); ++l) {
      const LinkPlan& from = *lanes[l]->links.data();
      const bsm::LinkConstants& constants = plans[l]->tree.links.data()[from.link];
      set_lane(r_HB_, l, constants.r_HP_P);
      set_lane(axis_, l, constants.axis_P);
      set_lane(rest_, l, constants.rest);
      position_[l % kLimbs<H, S>] = layout.position(from.link);
      rate_[l % kLimbs<H, S>] = layout.rate(from.link);
      if (!is_full && l % kLimbs < H, S >> 0) {
        this->set_idle(l);
        continue;
      }
      set_lane(dcm_BL_, l, constants.turn_fixed);
      set_lane(stiffness_, l, constants.stiffness);
      set_lane(damping_, l, constants.damping);
      this->set_mass(l, *plans[l], from);
    }
    this->put_mass(now_.mass);
  }

  void hold(std::size_t l, const LimbPlan& limb, const HeldInputsIn<Number<H>>& held) {
    if (this->is_idle(l)) return;
    const auto link = static_cast<std::size_t>(limb.links.data()->link);
    set_lane(effort_, l, held.effort.data()[link - 1]);
    set_lane(force_L_, l, held.force_L.data()[link]);
    set_lane(torque_L_, l, held.torque_L.data()[link]);
    set_lane(force_at_center_L_, l, held.force_at_center_L.data()[link]);
  }

  /// As of Limb.
  void watch() { is_watched_ = true; }
  LinkMotion<H> motion_of(std::size_t, std::size_t limb) const { return picked<H>(motion(), limb); }
  void push(std::size_t, std::size_t limb, const Pull<H>& pull) {
    add_to<H>(pushed_.force, limb, pull.force);
    add_to<H>(pushed_.torque, limb, pull.torque);
  }

  void move(const Number<H>* state, const Vec<S>& omega) {
    const S q = gather<H, S>(state, position_);
    const S q_dot = gather<H, S>(state, rate_);
    now_.r = r_HB_ + q * axis_;
    if (is_watched_) {
      omega_ = omega;
      now_.w = q_dot * axis_;
      pushed_ = {};
    }
    a_bias_ = cross(omega, cross(omega, now_.r) + (q_dot + q_dot) * axis_);
    u_ = effort_ - stiffness_ * (q - rest_) - damping_ * q_dot;
  }

  void contribute(const Field<S>* field, const Vec<S>* r_CB, Law<S>& law) {
    Vec<S> pull = dcm_BL_ * force_L_;
    Vec<S> torque = dcm_BL_ * torque_L_;
    if (is_watched_) {
      pull += pushed_.force;
      torque += pushed_.torque;
    }
    if (field != nullptr) pull += now_.mass * field->difference(now_.r);
    if (r_CB != nullptr) {
      const Vec<S> force = dcm_BL_ * force_at_center_L_;
      pull += force;
      torque += cross(*r_CB - now_.r, force);
    }
    const Vec<S> f0 = now_.mass * a_bias_ - pull;
    gain_ = inverse_mass_ * (u_ - dot(axis_, f0));

    const Vec<S>&r = now_.r, &s = axis_;
    const Vec<S> ms = now_.mass * s, mr = now_.mass * r, e = cross(r, s), me = now_.mass * e;
    const S mr2 = dot(mr, r);
    const Vec<S> f = f0 + gain_ * ms;
    law.J += {mr2 - mr.x * r.x - me.x * e.x, mr2 - mr.y * r.y - me.y * e.y,
              mr2 - mr.z * r.z - me.z * e.z, -(mr.x * r.y) - me.x * e.y,
              -(mr.x * r.z) - me.x * e.z,    -(mr.y * r.z) - me.y * e.z};
    law.M += {now_.mass - ms.x * s.x, now_.mass - ms.y * s.y, now_.mass - ms.z * s.z,
              -(ms.x * s.y),          -(ms.x * s.z),          -(ms.y * s.z)};
    law.H += {{-(me.x * s.x), mr.z - me.y * s.x, -mr.y - me.z * s.x},
              {-mr.z - me.x * s.y, -(me.y * s.y), mr.x - me.z * s.y},
              {mr.y - me.x * s.z, -mr.x - me.y * s.z, -(me.z * s.z)}};
    law.n0 += cross(r, f) - torque;
    law.f0 += f;
  }

  void recover(const Vec<S>& omega_dot_B, const Vec<S>& a_B, Number<H>* rate) const {
    scatter<H, S>(gain_ - dot(axis_, a_B + cross(omega_dot_B, now_.r)), rate, rate_);
  }

  // For the books, as of Limb.
  S inner_power(const Number<H>* state) const {
    const S q_dot = gather<H, S>(state, rate_);
    return (effort_ - damping_ * q_dot) * q_dot;
  }
  void trace(const Number<H>* state) { now_.w = gather<H, S>(state, rate_) * axis_; }
  void add_loads(const Vec<S>* r_CB, Outside<S>& sum) const {
    Pull<S> pull{dcm_BL_ * force_L_, dcm_BL_ * torque_L_};
    if (is_watched_) pull.add(pushed_);
    if (r_CB != nullptr) pull.add(dcm_BL_ * force_at_center_L_, *r_CB - now_.r);
    sum.add(pull, {dcm_BL_, {}, now_.r, now_.w});
  }

 private:
  using Particle<H, S>::inverse_mass_;
  using Particle<H, S>::now_;

  MountMotion<S> motion() const {
    return {dcm_BL_, omega_, now_.r, plus_cross(now_.w, omega_, now_.r)};
  }

  Vec<S> r_HB_, axis_;
  Mat<S> dcm_BL_;
  S stiffness_{}, damping_{}, rest_{}, effort_{};
  Vec<S> force_L_, torque_L_, force_at_center_L_;
  Places<H, S> position_{}, rate_{};
  Vec<S> a_bias_;
  bool is_watched_ = false;
  Vec<S> omega_;
  Pull<S> pushed_;
  S u_{}, gain_{};
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
