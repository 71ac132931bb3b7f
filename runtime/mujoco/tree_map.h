// How the shared state and the assembly's links map onto a loaded MuJoCo model. Names are looked up
// here, once; everything later is indices.
// Tested by tests/runtime/mujoco_test.cpp.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "compiler/ir/model.h"

namespace twincraft {

/// Indices into MuJoCo's arrays. The hub is body 1, with its free joint first in qpos and qvel.
struct TreeMap {
  std::vector<int> joint_qpos;  // per link but the hub
  std::vector<int> joint_dof;   // per link but the hub
  std::vector<int> wheel_dof;   // per rotor
  // Per link the body its joint belongs to. The two links of a spherical pendulum share the bob;
  // nothing acts on the first of them.
  std::vector<int> link_body;
};

constexpr int kHubBody = 1;
constexpr int kHubDofs = 6;

/// @throws NumericalFailure when `loaded` lacks a joint of `model`: the MJCF is not this model's
TreeMap map_tree(const Model& model, const mjModel& loaded);

/// What gravity pulls on, per link and in that link's axes. A body that does not move in its
/// mount's axes (welded, or a wheel, whose centre stays put and whose tensor does not see its spin)
/// is counted on the mount.
std::vector<std::vector<MassElement>> gravity_elements(const Model& model);

/// Give every body exactly the mass and moments of the model. MJCF can hold neither zeros nor a
/// flat body whose moments miss A + B >= C by rounding, so the printed ones may differ a little.
void restore_exact_masses(const BodyTree& tree, mjModel& loaded);

}  // namespace twincraft
