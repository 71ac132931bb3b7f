// See spin_up.h. Tested by tests/runtime/reference_test.cpp.
#include "runtime/reference/spin_up.h"

#include <cmath>
#include <numbers>

#include "compiler/ir/angle.h"

namespace twincraft {
namespace {

SpinUp spin_up_of(const Model& model) {
  const MassProperties hub = hub_properties(model);
  const Vector3d torque = load_torque(model, 0.0, hub.r_CL_L);
  const Vector3d& omega = model.initial.omega_BN_B;
  const bool turns = !omega.isZero(0.0);
  if (!turns && torque.isZero(0.0)) return {};
  using Vector = Eigen::Matrix<long double, 3, 1>;
  const Vector along = (turns ? omega : torque).cast<long double>();
  const long double size = along.stableNorm();
  const Vector axis = along / size;
  SpinUp spin_up{.axis_B = axis.cast<double>()};
  if (turns) spin_up.rate = size;
  const long double moment = axis.dot(hub.I_PntC_L.cast<long double>() * axis);
  spin_up.acceleration = axis.dot(torque.cast<long double>()) / moment;
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

std::vector<Deviation> spin_up_deviations(const Model& model,
                                          std::span<const Observation> samples) {
  const SpinUp truth = spin_up_of(model);
  Deviation attitude{.metric = "attitude_deg"};
  Deviation rate{.metric = "rate_rad_s"};
  for (const Observation& sample : samples) {
    const double time = sample.time - samples.front().time;
    const Quaterniond q_BN = samples.front().q_BN * truth.turn(time);
    attitude.see(kDegrees * principal_angle(q_BN, sample.q_BN), sample.time);
    rate.see((sample.omega_BN_B - truth.omega_BN_B(time)).norm(), sample.time);
  }
  return {attitude, rate};
}

}  // namespace twincraft
