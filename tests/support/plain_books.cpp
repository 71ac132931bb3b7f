// See plain_books.h. All vectors are in hub axes until they are booked.
#include "tests/support/plain_books.h"

#include <algorithm>

namespace twincraft::test {
namespace {

void add_power(double power, double own_power, SizedRates& rates) {
  rates.power += power;
  rates.own_power += own_power;
  rates.power_size += std::abs(power);
  rates.own_power_size += std::abs(own_power);
}
void add_force(const Vector3d& force_N, SizedRates& rates) {
  rates.force_N += force_N;
  rates.force_size += force_N.norm();
}
void add_torque(const Vector3d& torque_N, SizedRates& rates) {
  rates.torque_PntC_N += torque_N;
  rates.torque_size += torque_N.norm();
}

}  // namespace

struct PlainBooks::State : VehicleState {
  Matrix3d dcm_NB;
  Vector3d r_BN_B, v_BN_B;

  State(std::span<const double> state, const StateLayout& layout) {
    unpack(state, layout, *this);
    dcm_NB = q_BN.toRotationMatrix();
    r_BN_B = dcm_NB.transpose() * r_BN_N;
    v_BN_B = dcm_NB.transpose() * v_BN_N;
  }
};

PlainBooks::PlainBooks(const Model& model)
    : PlainVehicle(model),
      link_forces_(model.forces, inputs_at(model, 0.0)),
      inputs_(inputs_at(model, 0.0)),
      wrenches_(tree_.links.size()) {}

void PlainBooks::hold(const Inputs& inputs) {
  PlainVehicle::hold(inputs);
  inputs_ = inputs;
  link_forces_.hold(inputs);
}

SizedRates PlainBooks::rates(double time, std::span<const double> state) {
  const State x(state, layout_);
  move_to(time, x);
  const Center center = this->center();
  SizedRates rates;
  add_inner_power(x, rates);
  add_fall(x, center, rates);
  add_forces(time, x, center, rates);
  if (!propellant_.is_idle()) add_leaving(x, center, rates);
  return rates;
}

PlainBooks::Center PlainBooks::center() const {
  Center center;
  for (std::size_t i = 0; i < tree_.links.size(); ++i) {
    const bsm::LinkConstants& link = tree_.links[i];
    const Vector3d moment = motion_.poses[i].dcm_WL * link.first_moment;
    center.mass += link.mass;
    center.r_CB_B += link.mass * motion_.poses[i].r_LB_W + moment;
    center.v_CB_B +=
        link.mass * motion_.rates[i].v_LB_W + motion_.rates[i].omega_LN_W.cross(moment);
  }
  center.r_CB_B /= center.mass;
  center.v_CB_B /= center.mass;
  return center;
}

void PlainBooks::add_inner_power(const State& x, SizedRates& rates) const {
  const auto add = [&rates](double power) { add_power(power, power, rates); };
  for (std::size_t k = 0; k < x.joint_rate.size(); ++k) {
    const double rate = x.joint_rate[k];
    add(inputs_[inputs_.layout.effort(static_cast<int>(k))] * rate);
    add(-bsm::damping_of(tree_.links[k + 1], x.joint_position) * rate * rate);
  }
  for (std::size_t k = 0; k < x.wheel_rate.size(); ++k)
    add(inputs_[inputs_.layout.motor_torque(static_cast<int>(k))] * x.wheel_rate[k]);
}

void PlainBooks::add_fall(const State& x, const Center& center, SizedRates& rates) const {
  add_force(center.mass * forces_.fall(x.r_BN_N, x.dcm_NB, motion_.poses), rates);
}

void PlainBooks::add_forces(double time, const State& x, const Center& center, SizedRates& rates) {
  std::ranges::fill(wrenches_, Wrench{});
  Work work = forces_.apply(x.r_BN_B, motion_.poses, motion_.rates, wrenches_);
  if (link_forces_.acts())
    work += link_forces_.add({time, x.r_BN_N, x.v_BN_N, x.dcm_NB}, motion_.poses, motion_.rates,
                             wrenches_);
  add_power(work.power, 0.0, rates);
  add_power(work.force_W.dot(x.v_BN_B), 0.0, rates);
  for (std::size_t i = 0; i < wrenches_.size(); ++i) {
    const Vector3d& force = wrenches_[i].force_W;
    const Vector3d& torque = wrenches_[i].torque_PntB_W;
    const Vector3d& omega = motion_.rates[i].omega_LN_W;
    const Vector3d v_B = motion_.rates[i].v_LB_W - omega.cross(motion_.poses[i].r_LB_W);
    add_power(0.0, force.dot(v_B), rates);
    add_power(0.0, torque.dot(omega), rates);
    add_power(0.0, -force.dot(center.v_CB_B), rates);
    add_force(x.dcm_NB * force, rates);
    add_torque(x.dcm_NB * torque, rates);
    add_torque(x.dcm_NB * -center.r_CB_B.cross(force), rates);
  }
}

/// Propellant takes its own energy and momentum along, each link's by itself and about C.
void PlainBooks::add_leaving(const State& x, const Center& center, SizedRates& rates) const {
  const std::span<const double> share_rates = propellant_.share_rates();
  for (const bsm::Draining& draining : tree_.draining) {
    bsm::MassSums lost;  // per second
    for (const bsm::Draining::Part& part : draining.parts)
      lost.add(share_rates[part.tank], part.full);
    const LinkPose& pose = motion_.poses[draining.link];
    const LinkRate& rate = motion_.rates[draining.link];
    const Vector3d& omega = rate.omega_LN_W;
    const Vector3d moment = pose.dcm_WL * lost.first_moment;
    const Vector3d spin = pose.dcm_WL * (lost.J_L * (pose.dcm_WL.transpose() * omega));
    const Vector3d turning = omega.cross(moment);
    const Vector3d r_LC = pose.r_LB_W - center.r_CB_B;
    // Energy about a point that moves at -v past the link's origin.
    const auto energy = [&](const Vector3d& v) {
      return 0.5 * (lost.mass * v.squaredNorm() + omega.dot(spin)) + v.dot(turning);
    };
    const Vector3d v_LN = rate.v_LB_W + x.v_BN_B, v_LC = rate.v_LB_W - center.v_CB_B;
    add_power(energy(v_LN), energy(v_LC), rates);
    add_force(x.dcm_NB * (lost.mass * v_LN + turning), rates);
    add_torque(x.dcm_NB * (r_LC.cross(lost.mass * v_LC + turning) + moment.cross(v_LC) + spin),
               rates);
  }
  add_power(forces_.potential_rate(x.r_BN_B, motion_.poses, share_rates), 0.0, rates);
}

}  // namespace twincraft::test
