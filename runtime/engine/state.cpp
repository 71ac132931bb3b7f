#include "runtime/engine/state.h"

#include "runtime/engine/attitude.h"

namespace twincraft {
namespace {

void put(const std::vector<double>& values, int at, Eigen::VectorXd& state) {
  for (std::size_t i = 0; i < values.size(); ++i) state[at + static_cast<int>(i)] = values[i];
}

void take(const double* from, int count, std::vector<double>& to) {
  to.resize(static_cast<std::size_t>(count));
  for (double& value : to) value = *from++;
}

}  // namespace

Eigen::VectorXd pack(const VehicleState& state, const StateLayout& layout) {
  Eigen::VectorXd packed(layout.size());
  packed.segment<3>(StateLayout::position()) = state.r_BN_N;
  packed.segment<3>(StateLayout::velocity()) = state.v_BN_N;
  if (layout.translation) return packed;
  if (layout.chart == AttitudeChart::kMrp)
    packed.segment<3>(StateLayout::attitude()) = mrp_from(state.q_BN);
  else
    packed.segment<4>(StateLayout::attitude()) << state.q_BN.w(), state.q_BN.vec();
  packed.segment<3>(layout.rate()) = state.omega_BN_B;
  put(state.joint_position, layout.joint(), packed);
  put(state.joint_rate, layout.joint_rate(), packed);
  put(state.wheel_rate, layout.wheel(), packed);
  return packed;
}

void unpack(std::span<const double> state, const StateLayout& layout, VehicleState& to) {
  const double* from = state.data();
  to.r_BN_N = Vector3d::Map(from + StateLayout::position());
  to.v_BN_N = Vector3d::Map(from + StateLayout::velocity());
  take(from + layout.joint(), layout.joints, to.joint_position);
  take(from + layout.joint_rate(), layout.joints, to.joint_rate);
  take(from + layout.wheel(), layout.wheels, to.wheel_rate);
  to.q_BN = Quaterniond::Identity();
  to.omega_BN_B = Vector3d::Zero();
  if (layout.translation) return;
  const double* attitude = from + StateLayout::attitude();
  to.q_BN = layout.chart == AttitudeChart::kMrp
                ? quaternion_from(Vector3d::Map(attitude))
                : Quaterniond(attitude[0], attitude[1], attitude[2], attitude[3]).normalized();
  if (to.q_BN.w() < 0.0) to.q_BN.coeffs() = -to.q_BN.coeffs();
  to.omega_BN_B = Vector3d::Map(from + layout.rate());
}

}  // namespace twincraft
