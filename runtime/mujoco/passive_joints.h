// Springs and dampers of the joints, as MuJoCo loaded them: what mj_passive does for these models,
// without its search for tendons and fluids (a tenth of the whole evaluation of a rigid body), and
// with the drag of a pendulum, which MJCF cannot say.
// Tested by tests/runtime/mujoco_test.cpp and tests/components/battery_test.cpp.
#pragma once

#include <vector>

#include "compiler/ir/model.h"
#include "runtime/mujoco/tree_map.h"

namespace twincraft {

class PassiveJoints {
 public:
  PassiveJoints(const Assembly& assembly, const TreeMap& map, const mjModel& loaded);

  /// Write qfrc_passive of every joint.
  void apply(mjData& data) const;
  double spring_energy(const mjData& data) const;  // [J]
  double damper_power(const mjData& data) const;   // [W] taken out, not negative

 private:
  struct Joint {
    int qpos, dof;
    double stiffness, damping, rest;
    int cosine_qpos;  // damping is scaled by cos^2 of this coordinate; -1: constant
  };
  static double damping_of(const Joint& joint, const mjData& data);

  std::vector<Joint> joints_;
};

}  // namespace twincraft
