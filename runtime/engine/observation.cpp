#include "runtime/engine/observation.h"

namespace twincraft {

namespace {

/// The number itself; const where `seen` is.
template <class Seen>
auto& number_of(const OutputSignal& output, std::size_t component, Seen& seen) {
  const auto i = static_cast<Eigen::Index>(component);
  switch (output.of) {
    case OutputSignal::Of::kHubPosition:
      return seen.r_BN_N[i];
    case OutputSignal::Of::kHubVelocity:
      return seen.v_BN_N[i];
    case OutputSignal::Of::kAttitude:
      return seen.q_BN.coeffs()[i == 0 ? 3 : i - 1];  // Eigen stores the scalar last
    case OutputSignal::Of::kHubRate:
      return seen.omega_BN_B[i];
    case OutputSignal::Of::kComPosition:
      return seen.r_CN_N[i];
    case OutputSignal::Of::kComVelocity:
      return seen.v_CN_N[i];
    case OutputSignal::Of::kCoordinate:
      return seen.joint_position[output.coordinate->entry()];
    case OutputSignal::Of::kCoordinateRate:
      return (output.coordinate->is_wheel() ? seen.wheel_rate
                                            : seen.joint_rate)[output.coordinate->entry()];
    case OutputSignal::Of::kMass:
      break;
  }
  return seen.mass;
}

}  // namespace

double value_of(const OutputSignal& output, std::size_t component, const Observation& seen) {
  return number_of(output, component, seen);
}

double& place_of(const OutputSignal& output, std::size_t component, Observation& seen) {
  return number_of(output, component, seen);
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
