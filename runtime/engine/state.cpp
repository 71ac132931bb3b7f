#include "runtime/engine/state.h"

#include "runtime/engine/attitude.h"

namespace twincraft {
namespace {

void put(const std::vector<double>& values, int at, Eigen::VectorXd& state) {
  for (std::size_t i = 0; i < values.size(); ++i) state[at + static_cast<int>(i)] = values[i];
}

Vector3d three(std::span<const double> values, int at) { return Vector3d::Map(values.data() + at); }

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

UnpackedState unpack(std::span<const double> state, const StateLayout& layout) {
  const auto block = [&state](int at, int size) {
    return state.subspan(static_cast<std::size_t>(at), static_cast<std::size_t>(size));
  };
  UnpackedState unpacked{three(state, StateLayout::position()),
                         three(state, StateLayout::velocity()),
                         Vector3d::Zero(),
                         Quaterniond::Identity(),
                         block(layout.joint(), layout.joints),
                         block(layout.joint_rate(), layout.joints),
                         block(layout.wheel(), layout.wheels)};
  if (layout.translation) return unpacked;
  const double* attitude = state.data() + StateLayout::attitude();
  unpacked.q_BN =
      layout.chart == AttitudeChart::kMrp
          ? quaternion_from(Vector3d::Map(attitude))
          : Quaterniond(attitude[0], attitude[1], attitude[2], attitude[3]).normalized();
  unpacked.omega_BN_B = three(state, layout.rate());
  return unpacked;
}

void assign(const UnpackedState& from, VehicleState& to) {
  to.r_BN_N = from.r_BN_N;
  to.v_BN_N = from.v_BN_N;
  to.q_BN = from.q_BN;
  if (to.q_BN.w() < 0.0) to.q_BN.coeffs() = -to.q_BN.coeffs();
  to.omega_BN_B = from.omega_BN_B;
  to.joint_position.assign(from.joint_position.begin(), from.joint_position.end());
  to.joint_rate.assign(from.joint_rate.begin(), from.joint_rate.end());
  to.wheel_rate.assign(from.wheel_rate.begin(), from.wheel_rate.end());
}

}  // namespace twincraft
