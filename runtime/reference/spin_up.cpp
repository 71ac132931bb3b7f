// See spin_up.h. Tested by tests/runtime/reference_test.cpp.
#include "runtime/reference/spin_up.h"

#include <cmath>
#include <numbers>

namespace twincraft {
namespace {

// How parallel is parallel: a direction given in decimals and normalised is off by a few ulp.
constexpr double kParallel = 1.0e-12;

bool is_parallel(const Vector3d& vector, const Vector3d& axis) {
  return vector.cross(axis).norm() <= kParallel * vector.norm();
}

MassProperties hub_properties(const Model& model) {
  MassProperties hub;
  for (const MassElement& element : model.assembly.links[0].elements)
    hub = hub + properties_of(element);
  return hub;
}

Vector3d at_start(const std::array<Schedule, 3>& vector) {
  return {vector[0].at(0.0), vector[1].at(0.0), vector[2].at(0.0)};
}

/// Torque of all loads about the centre of mass at t = 0 [N m], hub axes.
Vector3d initial_torque(const Model& model, const Vector3d& r_CB_B) {
  Vector3d torque = Vector3d::Zero();
  for (const Load& load : model.loads) {
    torque += at_start(load.torque_L);
    if (load.r_FL_L) torque += (*load.r_FL_L - r_CB_B).cross(at_start(load.force_L));
  }
  return torque;
}

bool is_constant(const Load& load, double duration) {
  std::vector<const Schedule*> schedules;
  for (const Schedule& force : load.force_L) schedules.push_back(&force);
  for (const Schedule& torque : load.torque_L) schedules.push_back(&torque);
  return event_times(schedules, duration).empty();
}

SpinUp spin_up_of(const Model& model) {
  const MassProperties hub = hub_properties(model);
  const Vector3d torque = initial_torque(model, hub.r_CL_L);
  const Vector3d& omega = model.initial.omega_BN_B;
  const bool turns = !omega.isZero(0.0);
  if (!turns && torque.isZero(0.0)) return {};
  SpinUp spin_up{.axis_B = (turns ? omega : torque).normalized()};
  spin_up.rate = spin_up.axis_B.dot(omega);
  spin_up.acceleration =
      spin_up.axis_B.dot(torque) / spin_up.axis_B.dot(hub.I_PntC_L * spin_up.axis_B);
  return spin_up;
}

}  // namespace

Quaterniond SpinUp::turn(double time) const {
  // Many turns later the angle is large; reduce it before it becomes a double.
  const long double t = time;
  const long double angle = (rate + 0.5L * acceleration * t) * t;
  const long double reduced = std::remainder(angle, 2.0L * std::numbers::pi_v<long double>);
  return Quaterniond(Eigen::AngleAxisd(static_cast<double>(reduced), axis_B));
}

std::optional<std::string> spin_up_inapplicable(const Model& model, GravityLaw law) {
  if (model.simulation.translation) return "a point mass does not turn";
  if (model.assembly.links.size() > 1) return "the vehicle has joints";
  if (!model.assembly.rotors.empty()) return "the vehicle has wheels";
  if (law == GravityLaw::kBodyGradient) return "gravity turns the vehicle (`body_gradient`)";
  if (law == GravityLaw::kBodyCom && !all_mass_at_one_point(model))
    return "gravity at several points (`body_com`) turns the vehicle";
  for (const Load& load : model.loads) {
    if (!is_constant(load, model.simulation.duration))
      return "`" + load.name + "` changes during the run";
  }
  const MassProperties hub = hub_properties(model);
  const Vector3d axis = spin_up_of(model).axis_B;
  if (!is_parallel(initial_torque(model, hub.r_CL_L), axis))
    return "the torque about the centre of mass is not along the initial rate";
  const bool at_rest =
      model.initial.omega_BN_B.isZero(0.0) && initial_torque(model, hub.r_CL_L).isZero(0.0);
  if (!at_rest && !is_parallel(hub.I_PntC_L * axis, axis))
    return "rate and torque are not along a principal axis";
  return std::nullopt;
}

std::vector<Deviation> spin_up_deviations(const Model& model,
                                          std::span<const Observation> samples) {
  const SpinUp truth = spin_up_of(model);
  Deviation attitude{.metric = "attitude_deg"};
  Deviation rate{.metric = "rate_rad_s"};
  for (const Observation& sample : samples) {
    const double time = sample.time - samples.front().time;
    const Quaterniond q_BN = samples.front().q_BN * truth.turn(time);
    const Quaterniond off = q_BN.conjugate() * sample.q_BN;
    const double angle = 2.0 * std::atan2(off.vec().norm(), std::abs(off.w()));
    widen(attitude, angle * 180.0 / std::numbers::pi, sample.time);
    widen(rate, (sample.omega_BN_B - truth.omega_BN_B(time)).norm(), sample.time);
  }
  return {attitude, rate};
}

}  // namespace twincraft
