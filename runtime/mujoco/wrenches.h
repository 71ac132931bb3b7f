// Wrenches on links into MuJoCo's generalised forces, in one pass over the bodies. MuJoCo's own way
// (xfrc_applied) costs O(bodies x depth). Tested by tests/runtime/mujoco_test.cpp.
#pragma once

#include <mujoco/mujoco.h>

#include <span>
#include <vector>

#include "runtime/forces/forces.h"
#include "runtime/mujoco/tree_map.h"

namespace twincraft {

class WrenchProjector {
 public:
  WrenchProjector(const mjModel& model, const TreeMap& map);

  /// Add to `generalised` (nv entries) the forces of one wrench per link, about the hub origin, in
  /// world axes. @pre mj_kinematics and mj_comPos have run
  void add(const mjModel& model, const mjData& data, std::span<const Wrench> wrenches,
           std::span<double> generalised);

 private:
  std::vector<int> link_body_;
  std::vector<Wrench> subtree_;  // per body, of all outboard of it
};

}  // namespace twincraft
