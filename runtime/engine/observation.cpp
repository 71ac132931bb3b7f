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

}  // namespace twincraft
