#include "runtime/engine/observation.h"

namespace twincraft {

double value_of(const OutputSignal& output, std::size_t component, const Observation& seen) {
  const auto i = static_cast<Eigen::Index>(component);
  switch (output.of) {
    case OutputSignal::Of::kHubPosition:
      return seen.r_BN_N[i];
    case OutputSignal::Of::kHubVelocity:
      return seen.v_BN_N[i];
    case OutputSignal::Of::kAttitude:
      return i == 0 ? seen.q_BN.w() : seen.q_BN.vec()[i - 1];
    case OutputSignal::Of::kHubRate:
      return seen.omega_BN_B[i];
    case OutputSignal::Of::kComPosition:
      return seen.r_CN_N[i];
    case OutputSignal::Of::kComVelocity:
      return seen.v_CN_N[i];
    case OutputSignal::Of::kCoordinate:
      return position_of(*output.coordinate, seen);
    case OutputSignal::Of::kCoordinateRate:
      return rate_of(*output.coordinate, seen);
    case OutputSignal::Of::kMass:
      break;
  }
  return seen.mass;
}

void set_value(const OutputSignal& output, std::span<const double> numbers, VehicleState& state) {
  const auto vector = [&] { return Vector3d::Map(numbers.data()); };
  switch (output.of) {
    case OutputSignal::Of::kHubPosition:
      state.r_BN_N = vector();
      return;
    case OutputSignal::Of::kHubVelocity:
      state.v_BN_N = vector();
      return;
    case OutputSignal::Of::kAttitude:
      state.q_BN = Quaterniond(numbers[0], numbers[1], numbers[2], numbers[3]);
      return;
    case OutputSignal::Of::kHubRate:
      state.omega_BN_B = vector();
      return;
    case OutputSignal::Of::kCoordinate:
      state.joint_position[output.coordinate->entry()] = numbers[0];
      return;
    case OutputSignal::Of::kCoordinateRate:
      (output.coordinate->is_wheel() ? state.wheel_rate
                                     : state.joint_rate)[output.coordinate->entry()] = numbers[0];
      return;
    default:
      return;
  }
}

}  // namespace twincraft
