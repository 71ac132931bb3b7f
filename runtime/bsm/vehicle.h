// The derivative of a whole spacecraft: hub, limbs, attitude, gravity. See law.h for the
// equations. Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "runtime/bsm/book_page.h"
#include "runtime/bsm/charts.h"
#include "runtime/bsm/hub_equation.h"
#include "runtime/bsm/kernel.h"
#include "runtime/bsm/limbs.h"
#include "runtime/bsm/push.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

template <class H, class S>
class Bookkeeper;

/// @tparam H  scalar of the hub: a double, or one spacecraft per lane
/// @tparam S  of the limbs: two like ones per Pair, or H where the lanes are spacecraft
template <class H, class S>
requires KernelScalars<H, S>
class Vehicle {
 public:
  using Plans = std::span<const Plan* const>;  // one per lane of H, alike
  using Held = std::span<const HeldInputsIn<Number<H>>* const>;

  explicit Vehicle(Plans plans) : plan_(*plans[0]), tanks_(plans[0]->tree.tanks) {
    const int omega = Layout::kAttitude + (plan_.chart == AttitudeChart::kMrp ? 3 : 4);
    const int joint = omega + 3;
    layout_ = {omega, joint, joint + plan_.joints(), joint + 2 * plan_.joints()};
    elements_.resize(plan_.hub.elements.size());
    rotors_.resize(plan_.hub.rotors.size());
    for (std::size_t l = 0; l < plans.size(); ++l) set_hub(l, *plans[l]);
    set_hub_matrices();
    hub_ = hub_alone_;
    limbs_.build(plans, layout_);
    is_rigid_ = plan_.limbs.empty() && !plan_.tree.links.data()->drains;
    if (is_rigid_) {
      factors_.factor(hub_);
      inverse_inertia_ = factors_.schur.inverse();
    }
    for (const LimbPlan& limb : plan_.limbs) has_elements_ = has_elements_ || pulls_on(limb);
    has_elements_ = has_elements_ || !elements_.empty();
    pulls_on_hub_ = plan_.law == GravityLaw::kBodyGradient;
    for (const ElementNow<H>& element : elements_) pulls_on_hub_ |= !is_at_hub(element.r_EL);
    push_.build(plans, limbs_);
  }

  void hold(Held held) {
    acts_at_center_ = acts_on_hub_ = acts_beyond_hub_ = false;
    for (std::size_t l = 0; l < kLanes<H>; ++l) {
      set_lane(held_.force, l, *held[l]->force_L.data());
      set_lane(held_.torque, l, *held[l]->torque_L.data());
      set_lane(held_at_center_, l, *held[l]->force_at_center_L.data());
      acts_at_center_ = acts_at_center_ || held[l]->acts_at_center;
      acts_on_hub_ = acts_on_hub_ || held[l]->acts_on_hub;
      acts_beyond_hub_ = acts_beyond_hub_ || held[l]->acts_on_limbs;
      for (std::size_t k = 0; k < rotors_.size(); ++k) {
        rotors_[k].hold(l, held[l]->motor_torque.data()[plans_[l]->hub.rotors.data()[k]]);
      }
      push_.hold(l, *plans_[l], held[l]->inputs);
      tanks_.hold(l, held[l]->inputs);
    }
    acts_beyond_hub_ = acts_beyond_hub_ || acts_at_center_ || push_.acts();
    book_causes_ = {.drive = tanks_.flow() || acts_on_hub_ || acts_beyond_hub_,
                    .flow = tanks_.flow(),
                    .fall = plan_.law != GravityLaw::kNone,
                    .pull = has_elements_};
    turns_alone_ = is_rigid_ && !has_elements_ && !acts_at_center_ && !push_.exists();
    for (std::size_t l = 0; l < kLanes<H>; ++l) {
      const auto& held_force = *held[l]->force_L.data();
      turns_alone_ = turns_alone_ && vanishes(held_force.x()) && vanishes(held_force.y()) &&
                     vanishes(held_force.z()) &&
                     plans_[l]->tree.links.data()->first_moment.isZero(0.0);
    }
    held_n0_ = {};
    for (const RotorOn<H, H>& rotor : rotors_) held_n0_ += rotor.motor_torque * rotor.axis_L;
    held_n0_ -= held_.torque;
    if (turns_alone_) hub_.f0 = {};
    limbs_.for_each([this, &held](auto& group) {
      for (std::size_t l = 0; l < kLanes<S>; ++l) {
        const std::size_t p = l / kLimbs<H, S>;
        group.limb.hold(l, limbs_.plan_of(group, l, *plans_[p]), *held[p]);
      }
    });
    if (plan_.tree.tanks == 0) return;
    draining_.flow(tanks_);
    limbs_.for_each([this](auto& group) { group.limb.flow(tanks_); });
    drain(held[0]->inputs.since);
  }

  void derivative(Number<H> time, const Number<H>* state, Number<H>* rate) {
    if (turns_alone_) {
      if (plan_.chart == AttitudeChart::kMrp) return turn_alone<Mrp<H>>(state, rate);
      return turn_alone<Quaternion<H>>(state, rate);
    }
    if (tanks_.flow()) return derivative_draining(time, state, rate);
    derivative_steady(time, state, rate);
  }

  void finish_step(Number<H>* state) const {
    if (plan_.chart == AttitudeChart::kMrp) {
      Mrp<H> chart(state, Layout::kAttitude);
      chart.make_regular();
      chart.put(state, Layout::kAttitude);
    } else {
      Quaternion<H> chart(state, Layout::kAttitude);
      chart.make_regular();
      chart.put(state, Layout::kAttitude);
    }
  }

  const Law<H>& last_hub_law() const { return hub_; }

  /// Until the next hold().
  const BookCauses& book_causes() const { return book_causes_; }
  const Pull<H>& held_on_hub() const { return held_; }
  /// How fast it loses mass.
  const LinkMass<H>& hub_mass_rate() const { return draining_.mass_rate(); }

 private:
  friend class Bookkeeper<H, S>;  // reads what an evaluation leaves in memory

  void derivative_steady(Number<H> time, const Number<H>* state, Number<H>* rate) {
    if (plan_.chart == AttitudeChart::kMrp) {
      derivative_in<Mrp<H>>(time, state, rate);
    } else {
      derivative_in<Quaternion<H>>(time, state, rate);
    }
  }
  // Apart, so that a vehicle whose tanks stay as they are pays one test.
  [[gnu::noinline]] void derivative_draining(Number<H> time, const Number<H>* state,
                                             Number<H>* rate) {
    drain(time);
    derivative_steady(time, state, rate);
  }

  static Vec<H> vector(const Number<H>* state, int at) {
    return {entry<H>(state, at), entry<H>(state, at + 1), entry<H>(state, at + 2)};
  }
  static void put(const Vec<H>& v, Number<H>* state, int at) {
    put_entry(state, at, v.x);
    put_entry(state, at + 1, v.y);
    put_entry(state, at + 2, v.z);
  }

  void set_hub(std::size_t l, const Plan& plan) {
    plans_[l] = &plan;
    set_lane(mu_, l, plan.mu);
    mass_.set(l, *plan.tree.links.data());
    draining_.set(l, plan, plan.hub);
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      elements_[e].set(l, plan.hub.elements.data()[e]);
    }
    for (std::size_t k = 0; k < rotors_.size(); ++k) {
      const int rotor = plan.hub.rotors.data()[k];
      rotors_[k].set(l, plan.tree.rotors.data()[rotor], layout_.wheel + rotor);
    }
  }

  static bool pulls_on(const LimbPlan& limb) {
    bool pulls = false;
    for (const LinkPlan& link : limb.links) pulls = pulls || !link.elements.empty();
    for (const ChainPlan& chain : limb.chains) {
      for (const PlanarLinkPlan& link : chain.links) pulls = pulls || !link.elements.empty();
    }
    return pulls;
  }

  /// In every lane, for good: it feels the field that B does.
  static bool is_at_hub(const Vec<H>& r) {
    bool is_zero = true;
    for (std::size_t l = 0; l < kLanes<H>; ++l)
      is_zero =
          is_zero && vanishes(lane(r.x, l)) && vanishes(lane(r.y, l)) && vanishes(lane(r.z, l));
    return is_zero;
  }

  template <class Chart>
  void derivative_in(Number<H> time, const Number<H>* state, Number<H>* rate) {
    const Chart chart(state, Layout::kAttitude);
    const Vec<H> omega = vector(state, layout_.omega);
    dcm_NB_ = chart.dcm_NB();
    const Vec<S> omega_S = spread<S>(omega);
    limbs_.for_each([&](auto& group) { group.limb.move(state, omega_S); });

    begin_hub_law(omega, rotor_momentum(state, omega));
    if (push_.acts()) push(time, state, omega);
    sum_laws(vector(state, 0));
    HubMotion<H> hub;
    if (is_rigid_) {
      hub = factors_.solve(hub_);
    } else {
      HubFactors<H> factors;  // not factors_: these stay in registers
      factors.factor(hub_);
      hub = factors.solve(hub_);
    }

    const Vec<S> omega_dot_S = spread<S>(hub.omega_dot), a_S = spread<S>(hub.a);
    limbs_.for_each([&](auto& group) { group.limb.recover(omega_dot_S, a_S, rate); });
    put_hub_rates(chart, state, dcm_NB_ * hub.a + g_N_, hub.omega_dot, rate);
    const Layout layout = layout_;  // or every store would have it read again
    for (int i = layout.joint, from = layout.joint_rate; i < layout.joint_rate; ++i, ++from)
      put_entry(rate, i, entry<H>(state, from));
  }

  // Apart from derivative_in(): most vehicles have no such force.
  [[gnu::noinline]] void push(Number<H> time, const Number<H>* state, const Vec<H>& omega) {
    pushed_ = {};
    push_.add({H(time), vector(state, 0), vector(state, 3), dcm_NB_}, omega, limbs_,
              [this](const Pull<H>& pull) {
                pushed_.add(pull);
                hub_.f0 -= pull.force;
                hub_.n0 -= pull.torque;
              });
  }

  /// A rigid hub whose origin is its centre of mass, that no force acts on: rotation knows nothing
  /// of translation, nor the other way. Apart from derivative_in(), whose frame it does not need.
  template <class Chart>
  [[gnu::noinline]] void turn_alone(const Number<H>* state, Number<H>* rate) {
    const Vec<H> omega = vector(state, layout_.omega);
    const Vec<H> spin = rotor_momentum(state, omega);
    hub_.n0 = held_n0_ + cross(omega, mass_.J * omega + spin);
    Vec<H> g_N;
    if (plan_.law != GravityLaw::kNone) g_N = Field<H>(mu_, vector(state, 0), false).at_hub();
    const Chart chart(state, Layout::kAttitude);
    put_hub_rates(chart, state, g_N, -(inverse_inertia_ * hub_.n0), rate);
  }

  template <class Chart>
  void put_hub_rates(const Chart& chart, const Number<H>* state, const Vec<H>& v_dot,
                     const Vec<H>& omega_dot, Number<H>* rate) const {
    put(vector(state, 3), rate, 0);
    put(v_dot, rate, 3);
    chart.put_rate(vector(state, layout_.omega), rate, Layout::kAttitude);
    put(omega_dot, rate, layout_.omega);
    for (const RotorOn<H, H>& rotor : rotors_) {
      put_entry(rate, rotor.speed[0], rotor.spin_up - dot(rotor.axis_L, omega_dot));
    }
  }

  Vec<H> rotor_momentum(const Number<H>* state, const Vec<H>& omega) const {
    Vec<H> spin;
    for (const RotorOn<H, H>& rotor : rotors_) {
      const H speed = entry<H>(state, rotor.speed[0]);
      spin += (rotor.spin_inertia * (speed + dot(rotor.axis_L, omega))) * rotor.axis_L;
    }
    return spin;
  }

  /// Let masses be those that the tanks leave at `time` [s].
  void drain(Number<H> time) {
    tanks_.move_to(H(time));
    if (draining_.drains()) {
      mass_ = draining_.mass(tanks_);
      draining_.put_elements(tanks_, elements_);
      set_hub_matrices();
    }
    limbs_.for_each([this](auto& group) { group.limb.drain(tanks_); });
  }

  /// What of the hub's own law does not change with its motion.
  void set_hub_matrices() {
    hub_alone_.J = mass_.J;
    hub_alone_.H = cross_matrix(mass_.moment);
    hub_alone_.M = Sym<H>::isotropic(mass_.mass);
  }

  void begin_hub_law(const Vec<H>& omega, const Vec<H>& spin) {
    if (!is_rigid_) {
      hub_.J = hub_alone_.J;
      hub_.M = hub_alone_.M;
      hub_.H = hub_alone_.H;
    }
    hub_.n0 = held_n0_ + cross(omega, mass_.J * omega + spin);
    hub_.f0 = cross(omega, cross(omega, mass_.moment)) - held_.force;
  }

  /// The law of the whole vehicle about B, in a frame that falls by g_N_.
  void sum_laws(const Vec<H>& r_BN_N) {
    const bool is_uniform = plan_.law == GravityLaw::kSystemCom;
    Vec<H> r_CB;
    if (is_uniform || acts_at_center_) r_CB = center_of_mass();
    const Vec<H>* center = acts_at_center_ ? &r_CB : nullptr;
    if (acts_at_center_) {
      hub_.f0 -= held_at_center_;
      hub_.n0 -= cross(r_CB, held_at_center_);
    }
    if (plan_.law == GravityLaw::kNone) {
      add_limbs(nullptr, center);
      return;
    }
    const Field<H> field(mu_, is_uniform ? r_BN_N + dcm_NB_ * r_CB : r_BN_N,
                         plan_.law == GravityLaw::kBodyGradient);
    g_N_ = field.at_hub();
    if (!has_elements_) {
      if (tanks_.flow()) field_ = field.in_axes(dcm_NB_);
      add_limbs(nullptr, center);
      return;
    }
    const Field<H> field_B = field.in_axes(dcm_NB_);
    if (pulls_on_hub_) pull_on_hub(field_B);
    add_limbs(&field_B, center);
    field_ = field_B;  // not before: a law would wait for what was just stored
  }

  Vec<H> center_of_mass() const {
    Moment<H> sum{mass_.mass, mass_.moment};
    limbs_.for_each([&sum](const auto& group) {
      const Moment<S> limb = group.limb.moment();
      const auto both = [&group](const S& value) { return gathered<H, S>(value, group.is_full); };
      sum += {both(limb.mass), {both(limb.moment.x), both(limb.moment.y), both(limb.moment.z)}};
    });
    return (H(1.0) / sum.mass) * sum.moment;
  }

  void pull_on_hub(const Field<H>& field) {
    Pull<H> pull;
    Vec<H> turn;
    for (const ElementNow<H>& element : elements_) {
      pull.add(element.mass * field.difference(element.r_EL), element.r_EL);
      if (field.has_gradient) turn += field.gradient_torque(element.r_EL, element.I);
    }
    pull.torque += turn;
    hub_.f0 -= pull.force;
    hub_.n0 -= pull.torque;
    pulled_hub_ = {pull.force, pull.torque};
    turned_hub_ = turn;
  }

  void add_limbs(const Field<H>* field, const Vec<H>* r_CB) {
    if (field == nullptr && r_CB == nullptr) return add_limbs_in(nullptr, nullptr);
    // Not zeroed first where they are told: that takes longer than to spread them.
    const Field<S> field_S = field == nullptr ? Field<S>() : spread<S>(*field);
    const Vec<S> r_CB_S = r_CB == nullptr ? Vec<S>() : spread<S>(*r_CB);
    add_limbs_in(field == nullptr ? nullptr : &field_S, r_CB == nullptr ? nullptr : &r_CB_S);
  }
  void add_limbs_in(const Field<S>* field, const Vec<S>* r_CB) {
    if (limbs_.has_particles()) {
      Law<S> sum;
      limbs_.for_each_particle([&](auto& group) { group.limb.contribute(field, r_CB, sum); });
      add(sum, true);
    }
    limbs_.for_each_tree(
        [&](auto& group) { add(group.limb.contribute(field, r_CB), group.is_full); });
  }

  void add(const Law<S>& law, bool is_full) {
    is_full ? hub_.template add_gathered<true>(law) : hub_.template add_gathered<false>(law);
  }

  const Plan& plan_;  // of lane 0, for what all share
  std::array<const Plan*, kLanes<H>> plans_{};
  Tanks<H> tanks_;
  Layout layout_;
  H mu_{};
  LinkMass<H> mass_;
  LinkDrain<H, H> draining_;
  std::vector<ElementNow<H>> elements_;
  std::vector<RotorOn<H, H>> rotors_;
  Pull<H> held_;
  Vec<H> held_at_center_;
  bool acts_at_center_ = false;
  bool acts_on_hub_ = false, acts_beyond_hub_ = false;  // in some lane, until the next hold()
  BookCauses book_causes_;
  Vec<H> held_n0_;  // of rotors' motors and of what is held
  Limbs<H, S> limbs_;
  bool is_rigid_ = false;      // no limbs, no draining: factored once
  bool turns_alone_ = false;   // see turn_alone()
  bool has_elements_ = false;  // that may feel another field than B does
  bool pulls_on_hub_ = false;  // some element of the hub does, or feels a gradient
  HubFactors<H> factors_;      // of a rigid hub
  Sym<H> inverse_inertia_;     // of a rigid hub, about its centre of mass
  Law<H> hub_alone_, hub_;
  Mat<H> dcm_NB_;       // unless it turns alone; so is
  Vec<H> g_N_;          // [m/s^2] the common acceleration of the falling frame
  Pull<H> pulled_hub_;  // by gravity, beyond what B feels, where elements of it do
  Vec<H> turned_hub_;   // [N m] of that the gradient's torque alone
  Field<H> field_;      // in hub axes, where elements or books ask for it
  Push<H, S> push_;     // of forces that follow the motion of links
  Pull<H> pushed_;      // of them, on the hub
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
