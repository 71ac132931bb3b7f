// What crosses the border to MuJoCo: our state becomes its positions and velocities, its
// accelerations become the rates of our state. The attitude is a quaternion on both sides.
// Tested by tests/runtime/mujoco_test.cpp.
#pragma once

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

#include "compiler/ir/model.h"
#include "runtime/engine.h"
#include "runtime/mujoco/tree_map.h"

namespace twincraft {

/// How the hub is placed in MuJoCo's world for an evaluation.
enum class Placement {
  kAligned,  // at rest at zero, its axes along the world's: the co-moving frame
  kCentred,  // at rest at zero, with its true attitude: for observations in N
  kRaw,      // as it is: the inertial frame of the paper
};

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

}  // namespace twincraft
