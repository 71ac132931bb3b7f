// The state both engines integrate: one flat vector, the same blocks in the same order.
#pragma once

#include <Eigen/Core>
#include <span>

#include "compiler/ir/model.h"

namespace twincraft {

/// Where each block of a state vector begins.
///   r_BN_N [m], v_BN_N [m/s], attitude (MRP sigma_BN or quaternion scalar first, B to N),
///   omega_BN_B [rad/s], q (per joint), qDot, wheel speeds relative to the mount [rad/s]
/// A point mass has the first two alone.
struct StateLayout {
  AttitudeChart chart = AttitudeChart::kMrp;
  int joints = 0;
  int wheels = 0;
  bool translation = false;  // a point mass

  static constexpr int position() { return 0; }
  static constexpr int velocity() { return 3; }
  static constexpr int attitude() { return 6; }
  int attitude_size() const {
    if (translation) return 0;
    return chart == AttitudeChart::kMrp ? 3 : 4;
  }
  int rate() const { return attitude() + attitude_size(); }
  int rate_size() const { return translation ? 0 : 3; }
  int joint() const { return rate() + rate_size(); }
  int joint_rate() const { return joint() + joints; }
  int wheel() const { return joint_rate() + joints; }
  int size() const { return wheel() + wheels; }

  /// Velocity coordinates.
  int degrees_of_freedom() const { return 3 + rate_size() + joints + wheels; }
};

/// `state` as a state vector.
Eigen::VectorXd pack(const VehicleState& state, const StateLayout& layout);

/// All that a state vector says; a point mass is at rest about N. A quaternion is read as if
/// normalised; the scalar of q_BN is not negative.
void unpack(std::span<const double> state, const StateLayout& layout, VehicleState& to);

}  // namespace twincraft
