// What crosses the border to MuJoCo: our state becomes its positions and velocities, its
// accelerations become the rates of our state. The attitude is a quaternion on both sides.
// Tested by tests/runtime/mujoco_test.cpp.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "compiler/ir/model.h"
#include "runtime/engine/engine.h"
#include "runtime/mujoco/tree_map.h"

namespace twincraft {

/// How the hub is placed in MuJoCo's world for an evaluation.
enum class Placement {
  kAligned,  // at rest at zero, its axes along the world's: the co-moving frame
  kCentred,  // at rest at zero, with its true attitude: for observations in N
  kRaw,      // as it is: the inertial frame of the paper
};

/// qDot = 1/2 q (x) (0, omega_BN_B), scalar first, of the normalised quaternion, as MuJoCo reads
/// it.
inline void write_quaternion_rate(const double* q, const double* omega, double* rate) {
  const double half = 0.5 / std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  const double w = half * q[0], x = half * q[1], y = half * q[2], z = half * q[3];
  rate[0] = -x * omega[0] - y * omega[1] - z * omega[2];
  rate[1] = w * omega[0] + y * omega[2] - z * omega[1];
  rate[2] = w * omega[1] + z * omega[0] - x * omega[2];
  rate[3] = w * omega[2] + x * omega[1] - y * omega[0];
}

class Exchange {
 public:
  Exchange(const Assembly& assembly, const TreeMap& map);

  const StateLayout& layout() const { return layout_; }

  void hand_over(const double* state, Placement placement, mjData& data) const;

  /// @param a_BN_N  of the hub's origin in N, with the frame's own fall [m/s2]
  /// @param rate    receives the rate of `state`
  /// @return a sum that is finite only if every acceleration is
  double take_back(const double* state, const Vector3d& a_BN_N, const mjData& data,
                   double* rate) const;

  /// An entry of the state in words: "rate of `wing.1`".
  std::string name(int index) const;

 private:
  StateLayout layout_;
  TreeMap map_;
  std::vector<std::string> joint_names_;
  std::vector<std::string> wheel_names_;
};

// In sight of the engine, whose every evaluation calls them: across files they cost half a
// percent of a small vehicle's step.
//
// MuJoCo normalises the quaternion in place, which is not idempotent in the last bit, so everything
// is copied anew before every evaluation.
inline void Exchange::hand_over(const double* state, Placement placement, mjData& data) const {
  static constexpr double kIdentity[4] = {1.0, 0.0, 0.0, 0.0};
  double* qpos = data.qpos;
  double* qvel = data.qvel;
  const bool raw = placement == Placement::kRaw;
  for (int i = 0; i < 3; ++i) {
    qpos[i] = raw ? state[StateLayout::position() + i] : 0.0;
    qvel[i] = raw ? state[StateLayout::velocity() + i] : 0.0;
    qvel[3 + i] = state[layout_.rate() + i];
  }
  const bool aligned = placement == Placement::kAligned;
  std::copy_n(aligned ? kIdentity : state + StateLayout::attitude(), 4, qpos + 3);
  for (int i = 0; i < layout_.joints; ++i) {
    qpos[map_.joint_qpos.data()[i]] = state[layout_.joint() + i];
    qvel[map_.joint_dof.data()[i]] = state[layout_.joint_rate() + i];
  }
  for (int i = 0; i < layout_.wheels; ++i) {
    qvel[map_.wheel_dof.data()[i]] = state[layout_.wheel() + i];
  }
}

inline double Exchange::take_back(const double* state, const Vector3d& a_BN_N, const mjData& data,
                                  double* rate) const {
  const double* qacc = data.qacc;
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) {
    rate[StateLayout::position() + i] = state[StateLayout::velocity() + i];
    sum += rate[StateLayout::velocity() + i] = a_BN_N[i];
    sum += rate[layout_.rate() + i] = qacc[3 + i];
  }
  write_quaternion_rate(state + StateLayout::attitude(), state + layout_.rate(),
                        rate + StateLayout::attitude());
  for (int i = 0; i < layout_.joints; ++i) {
    rate[layout_.joint() + i] = state[layout_.joint_rate() + i];
    sum += rate[layout_.joint_rate() + i] = qacc[map_.joint_dof.data()[i]];
  }
  for (int i = 0; i < layout_.wheels; ++i) {
    sum += rate[layout_.wheel() + i] = qacc[map_.wheel_dof.data()[i]];
  }
  return sum;
}

}  // namespace twincraft
