// A limb: what hangs on the hub by one joint, or like limbs side by side in the lanes of S. Here of
// any form; those of a frequent form are written out in chain_limb.h, point.h and bob.h.
// See law.h for the equations. Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "runtime/bsm/chain.h"
#include "runtime/bsm/draining.h"
#include "runtime/bsm/law.h"
#include "runtime/bsm/outside.h"
#include "runtime/bsm/parts.h"
#include "runtime/bsm/plan.h"
#include "runtime/bsm/rotor.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

template <class H, class S>
requires KernelScalars<H, S>
class Limb {
 public:
  using Lanes = std::span<const LimbPlan* const>;  // one per lane of S, alike
  using Plans = std::span<const Plan* const>;      // whose limbs they are

  Limb(Lanes lanes, Plans plans, const Layout& layout);  // in limb_build.h

  /// Let masses change as the tanks do until the next hold().
  void flow(const Tanks<H>& tanks) {
    for (DrainingLink& draining : draining_) draining.drain.flow(tanks);
  }
  /// Let masses be those that the tanks leave.
  void drain(const Tanks<H>& tanks) {
    for (const DrainingLink& draining : draining_) {
      Link& link = links_[draining.link];
      link.mass = draining.drain.mass(tanks);
      draining.drain.put_elements(tanks, link.elements);
    }
  }

  void hold(std::size_t l, const LimbPlan& limb, const HeldInputsIn<Number<H>>& held) {
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const LinkPlan& from = limb.links.data()[i];
      const auto link = static_cast<std::size_t>(from.link);
      set_lane(links_[i].effort, l, held.effort.data()[link - 1]);
      if (l == 0) links_[i].is_held = false;
      links_[i].is_held =
          links_[i].is_held || acts(held.force_L.data()[link]) || acts(held.torque_L.data()[link]);
      set_lane(links_[i].held.force, l, held.force_L.data()[link]);
      set_lane(links_[i].held.torque, l, held.torque_L.data()[link]);
      set_lane(links_[i].held_at_center, l, held.force_at_center_L.data()[link]);
      for (std::size_t k = 0; k < links_[i].rotors.size(); ++k) {
        links_[i].rotors[k].hold(l, held.motor_torque.data()[from.rotors.data()[k]]);
      }
    }
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      chains_[c].hold(l, limb.chains.data()[c], held);
    }
  }

  /// Links that forces may push: their velocities are told too, and what is pushed is added.
  void watch() { is_watched_ = true; }
  /// How link i of a limb moves, after move().
  LinkMotion<H> motion_of(std::size_t i, std::size_t limb) const {
    MountMotion<S> motion = motions_[i].at;
    motion.dcm_WL = dcm_WL(i);
    return picked<H>(motion, limb);
  }
  void push(std::size_t i, std::size_t limb, const Pull<H>& pull) {
    add_to<H>(motions_[i].pushed.force, limb, pull.force);
    add_to<H>(motions_[i].pushed.torque, limb, pull.torque);
  }

  /// Positions and rates of all links from those of the hub.
  void move(const Number<H>* state, const Vec<S>& omega_BN_B) {
    hub_.omega = omega_BN_B;
    if (!hinges_.empty()) turn_hinges(state);
    for (std::size_t i = 0; i < links_.size(); ++i) move_link(i, state);
    for (Chain<H, S>& chain : chains_) chain.move(state, mount(chain.mount()));
  }

  Moment<S> moment() const {
    Moment<S> sum;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const S& mass = links_[i].mass.mass;
      sum += {mass, motions_[i].moment + mass * motions_[i].at.r_LB};
    }
    for (const Chain<H, S>& chain : chains_) sum += chain.moment();
    return sum;
  }

  /// The limb's law about B, until the next call.
  /// @param field  null: nothing pulls  @param r_CB  [m] null: nothing acts at the centre of mass
  const Law<S>& contribute(const Field<S>* field, const Vec<S>* r_CB) {
    for (const Chain<H, S>& chain : chains_) laws_[index(chain.mount())] = {};
    for (Chain<H, S>& chain : chains_)
      chain.template tell<false>(field, laws_[index(chain.mount())]);
    for (std::size_t i = links_.size(); i-- > 1;) {
      Law<S>& parent = laws_[index(links_[i].parent)];
      if (links_[i].tells_first)
        tell<true>(i, field, r_CB, parent);
      else
        tell<false>(i, field, r_CB, parent);
    }
    tell<true>(0, field, r_CB, hub_law_);
    return hub_law_;
  }

  /// Accelerations of joints and rotors from those of the hub.
  void recover(const Vec<S>& omega_dot_B, const Vec<S>& a_B, Number<H>* rate) {
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const Link& link = links_[i];
      Motion& m = motions_[i];
      const Recovery& r = recoveries_[i];
      const Vec<S>& omega_dot_P =
          link.parent < 0 ? omega_dot_B : motions_[index(link.parent)].omega_dot;
      const Vec<S>& a_P = link.parent < 0 ? a_B : motions_[index(link.parent)].a;
      const Vec<S> a_joint = plus_cross(a_P, omega_dot_P, m.r_HP);
      const S q_ddot = r.gain - dot(r.gain_n, omega_dot_P) - dot(r.gain_f, a_joint);
      scatter<H, S>(q_ddot, rate, link.rate);
      m.omega_dot = omega_dot_P + m.omega_bias;
      m.a = a_joint + m.a_bias;
      (link.slides ? m.a : m.omega_dot) += q_ddot * m.axis();
      for (const RotorOn<H, S>& rotor : link.rotors)
        scatter<H, S>(rotor.spin_up - dot(rotor.axis, m.omega_dot), rate, rotor.speed);
    }
    for (const Chain<H, S>& chain : chains_) {
      const Motion& mount = motions_[index(chain.mount())];
      chain.recover(mount.omega_dot, mount.a, rate);
    }
  }

  // For the books, after a derivative at the same state: in limb_books.h.

  /// Of efforts, motors and dampers [W].
  S inner_power(const Number<H>* state) const;
  /// The velocities that move() leaves out. All that follows needs them.
  void trace(const Number<H>*) {
    for (std::size_t i = 0; i < links_.size(); ++i) set_velocity(i);
  }
  // Seen from the hub's axes, in which the links' own velocities are not.
  void add_motion(MassMotion<S>& sum) const;
  /// What is held, and what follows the motion. @param r_CB  as of contribute()
  void add_loads(const Vec<S>* r_CB, Outside<S>& sum) const;
  void add_gravity(const Field<S>& field, Outside<S>& sum) const;
  void add_leaving(Leaving<S>& sum) const;
  /// See lifted().
  void add_lifted(const Field<S>& field, Power<S>& sum) const;

 private:
  struct Link {
    int parent = -1;
    bool slides = false;
    int damped_by_cosine_of = -1;
    bool is_massless = true;  // for good, in every lane, and without rotors
    bool is_held = false;     // by a load, in some lane
    bool tells_first = true;  // of all that its parent is told
    Mat<S> dcm_KL, dcm_PK0;   // P: the parent's axes K, or the hub's
    Vec<S> r_HP_P;
    S stiffness{}, damping{}, rest{}, effort{};
    Pull<S> held;           // link axes L, about the origin
    Vec<S> held_at_center;  // [N] link axes L
    LinkMass<S> mass;       // axes K, as of elements and rotors
    Places<H, S> position{}, rate{};
    std::vector<ElementNow<S>> elements;
    std::vector<RotorOn<H, S>> rotors;
  };
  struct Motion {
    MountMotion<S> at;  // of axes K
    S u{};              // effort and spring
    S q{}, q_dot{};
    SineCosine<S> turn{S(0.0), S(1.0)};  // of a hinge's angle
    Vec<S> r_HP;                         // [m] link origin from its parent's
    Vec<S> omega_bias;                   // omegaDot = omegaDot_P + omega_bias + s qDDot (hinge)
    Vec<S> a_bias;                       // a = a_P + omegaDot_P x r_HP + a_bias + s qDDot (slide)
    Vec<S> moment;                       // [kg m] from the origin
    Vec<S> omega_dot, a;
    Pull<S> pushed;  // about the origin, by forces that follow the motion

    const Vec<S>& axis() const { return at.dcm_WL.z; }  // s
  };
  struct DrainingLink {
    std::size_t link = 0;
    LinkDrain<H, S> drain;
  };
  /// qDDot = gain - gain_n . omegaDot_P - gain_f . a', a' the parent's acceleration at the joint.
  struct Recovery {
    S gain;
    Vec<S> gain_n, gain_f;
  };

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  const MountMotion<S>& mount(int i) const { return i < 0 ? hub_ : motions_[index(i)].at; }
  Mat<S> dcm_WL(std::size_t i) const { return motions_[i].at.dcm_WL * links_[i].dcm_KL; }

  void set(std::size_t l, const LimbPlan& limb, const Plan& plan, const Layout& layout);
  void turn_links();
  void find_first_to_tell();

  static bool acts(const typename HeldInputsIn<Number<H>>::Vector& v) {
    return !(vanishes(v.x()) && vanishes(v.y()) && vanishes(v.z()));
  }

  void set_velocity(std::size_t i) {
    Motion& m = motions_[i];
    const MountMotion<S>& parent = mount(links_[i].parent);
    m.at.v_LB = parent.v_LB + cross(parent.omega, m.r_HP);
    if (links_[i].slides) m.at.v_LB += m.q_dot * m.axis();
  }

  void turn_hinges(const Number<H>* state) {
    for (const std::size_t i : hinges_) motions_[i].q = gather<H, S>(state, links_[i].position);
    std::size_t k = 0;
    if constexpr (kTakesTwoAngles<S>) {
      for (; k + 1 < hinges_.size(); k += 2) {
        Motion &m = motions_[hinges_[k]], &next = motions_[hinges_[k + 1]];
        put_sines_cosines(m.q, next.q, m.turn, next.turn);
      }
    }
    for (; k < hinges_.size(); ++k) motions_[hinges_[k]].turn = sine_cosine(motions_[hinges_[k]].q);
  }

  void move_link(std::size_t i, const Number<H>* state) {
    const Link& link = links_[i];
    Motion& m = motions_[i];
    const MountMotion<S>& parent = mount(link.parent);
    Mat<S> dcm = link.dcm_PK0;
    m.r_HP = link.r_HP_P;
    if (link.parent >= 0) {
      dcm = parent.dcm_WL * dcm;
      m.r_HP = parent.dcm_WL * m.r_HP;
    }
    const Vec<S> slip = cross(parent.omega, dcm.z);
    m.q_dot = gather<H, S>(state, link.rate);
    if (link.slides) {
      m.q = gather<H, S>(state, link.position);
      m.r_HP += m.q * dcm.z;
      m.at.omega = parent.omega;
      m.omega_bias = {};
      m.a_bias = cross(parent.omega, cross(parent.omega, m.r_HP)) + (m.q_dot + m.q_dot) * slip;
    } else {
      const auto& [sine, cosine] = m.turn;
      const Vec<S> x = dcm.x;
      dcm.x = cosine * x + sine * dcm.y;
      dcm.y = cosine * dcm.y - sine * x;
      m.at.omega = parent.omega + m.q_dot * dcm.z;
      m.omega_bias = m.q_dot * slip;
      m.a_bias = cross(parent.omega, cross(parent.omega, m.r_HP));
    }
    m.at.dcm_WL = dcm;
    m.at.r_LB = parent.r_LB + m.r_HP;
    m.moment = dcm * link.mass.moment;
    m.u = link.effort - link.stiffness * (m.q - link.rest);
    if (is_watched_) {
      set_velocity(i);
      m.pushed = {};
    }
    for (RotorOn<H, S>& rotor : links_[i].rotors) rotor.move(state, m.at);
  }

  void add_seen_from_hub(Outside<S>& own, Outside<S>& sum) const;

  S damping(const Link& link) const {
    if (link.damped_by_cosine_of < 0) return link.damping;
    const S& cosine = motions_[index(link.damped_by_cosine_of)].turn.cosine;
    return link.damping * cosine * cosine;
  }

  /// Let the parent know what link i and all beyond it ask, about the parent's origin.
  template <bool kIsFirst>
  void tell(std::size_t i, const Field<S>* field, const Vec<S>* r_CB, Law<S>& parent) {
    Law<S> law = laws_[i];
    add_own(i, law);
    add_loads(i, field, r_CB, law);
    eliminate(i, law);
    parent.template take<kIsFirst>(law, motions_[i].r_HP);
  }

  [[gnu::always_inline]] void add_own(std::size_t i, Law<S>& law) const {
    const Link& link = links_[i];
    const Motion& m = motions_[i];
    if (link.is_massless) return;
    const Vec<S>&omega = m.at.omega, &moment = m.moment;
    const Sym<S> J = link.mass.J.turned(m.at.dcm_WL);
    law.J += J;
    law.H.add_cross_matrix(moment);
    law.M.add_isotropic(link.mass.mass);
    Vec<S> spin = J * omega;
    for (const RotorOn<H, S>& rotor : link.rotors) spin += rotor.momentum * rotor.axis;
    law.n0 = plus_cross(law.n0, omega, spin);
    law.f0 = plus_cross(law.f0, omega, cross(omega, moment));
  }

  /// Of motors, loads, forces and gravity.
  [[gnu::always_inline]] void add_loads(std::size_t i, const Field<S>* field, const Vec<S>* r_CB,
                                        Law<S>& law) const {
    const Link& link = links_[i];
    const Motion& m = motions_[i];
    for (const RotorOn<H, S>& rotor : link.rotors) law.n0 += rotor.motor_torque * rotor.axis;
    if (link.is_held) {
      const Mat<S> dcm = dcm_WL(i);
      law.n0 -= dcm * link.held.torque;
      law.f0 -= dcm * link.held.force;
    }
    if (is_watched_) {
      law.n0 -= m.pushed.torque;
      law.f0 -= m.pushed.force;
    }
    if (field != nullptr) {
      const Pull<S> sum = pull(i, *field);
      law.n0 -= sum.torque;
      law.f0 -= sum.force;
    }
    if (r_CB != nullptr) {
      const Vec<S> force = dcm_WL(i) * link.held_at_center;
      law.f0 -= force;
      law.n0 -= cross(*r_CB - m.at.r_LB, force);
    }
  }

  Pull<S> pull(std::size_t i, const Field<S>& field) const {
    const Motion& m = motions_[i];
    Pull<S> sum;
    for (const ElementNow<S>& element : links_[i].elements) {
      const Vec<S> r_EL = m.at.dcm_WL * element.r_EL;
      const Vec<S> place = m.at.r_LB + r_EL;
      sum.add(element.mass * field.difference(place), r_EL);
      if (field.has_gradient) {
        sum.torque += field.gradient_torque(place, element.I.turned(m.at.dcm_WL));
      }
    }
    return sum;
  }

  /// Take the joint's own acceleration out.
  [[gnu::always_inline]] void eliminate(std::size_t i, Law<S>& law) {
    const Motion& m = motions_[i];
    const Vec<S>& s = m.axis();

    // Known part of the link's own acceleration; U: how n and f answer to qDDot. Along the joint
    // the effort alone acts.
    law.n0 = plus_product(law.n0, law.H, m.a_bias);
    law.f0 = plus_product(law.f0, law.M, m.a_bias);
    Vec<S> U_n, U_f;
    S along, known;
    if (links_[i].slides) {
      U_n = law.H * s;
      U_f = law.M * s;
      along = dot(s, U_f);
      known = dot(s, law.f0);
    } else {
      law.n0 = plus_product(law.n0, law.J, m.omega_bias);
      law.f0 = plus_transposed(law.f0, law.H, m.omega_bias);
      U_n = law.J * s;
      U_f = transposed(law.H, s);
      along = dot(s, U_n);
      known = dot(s, law.n0);
    }
    const S inverse = S(1.0) / along;
    const S gain = inverse * (m.u - damping(links_[i]) * m.q_dot - known);
    Recovery& r = recoveries_[i];
    r = {gain, inverse * U_n, inverse * U_f};

    law.J.subtract(U_n, r.gain_n);
    law.H.subtract(U_n, r.gain_f);
    law.M.subtract(U_f, r.gain_f);
    law.n0 += gain * U_n;
    law.f0 += gain * U_f;
  }

  std::vector<Link> links_;
  std::vector<std::size_t> hinges_;  // of them
  std::vector<DrainingLink> draining_;
  std::vector<Motion> motions_;
  Law<S> hub_law_;            // about B
  std::vector<Law<S>> laws_;  // that what hangs on a link asks of it; never anything of a leaf
  std::vector<Recovery> recoveries_;
  std::vector<Chain<H, S>> chains_;
  MountMotion<S> hub_ = hub_itself<S>();
  bool is_watched_ = false;
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
