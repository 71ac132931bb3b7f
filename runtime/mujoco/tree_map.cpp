// Decides by name which MuJoCo joint is which coordinate, and puts the model's exact masses back.
// Tested by tests/runtime/mujoco_test.cpp.
#include "runtime/mujoco/tree_map.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/engine/engine.h"

namespace twincraft {
namespace {

int find(const mjModel& loaded, mjtObj type, const std::string& name) {
  const int id = mj_name2id(&loaded, type, name.c_str());
  if (id < 0) throw NumericalFailure(fmt::format("mujoco: the MJCF has no `{}`", name));
  return id;
}

}  // namespace

TreeMap map_tree(const Model& model, const mjModel& loaded) {
  TreeMap map;
  map.link_body.push_back(kHubBody);
  for (std::size_t i = 1; i < model.assembly.links.size(); ++i) {
    const int joint = find(loaded, mjOBJ_JOINT, model.assembly.links[i].name);
    map.joint_qpos.push_back(loaded.jnt_qposadr[joint]);
    map.joint_dof.push_back(loaded.jnt_dofadr[joint]);
    map.link_body.push_back(loaded.jnt_bodyid[joint]);
  }
  map.wheel_dof.resize(model.assembly.rotors.size());
  for (const TreeWheel& wheel : model.tree.wheels) {
    const int joint = find(loaded, mjOBJ_JOINT, wheel.joint);
    map.wheel_dof[static_cast<std::size_t>(wheel.rotor)] = loaded.jnt_dofadr[joint];
  }
  return map;
}

std::vector<std::vector<MassElement>> gravity_elements(const Model& model) {
  std::vector<std::vector<MassElement>> elements(model.assembly.links.size());
  const std::vector<Seat> seats = seats_of(model.tree);
  for (std::size_t i = 0; i < seats.size(); ++i) {
    const Seat& seat = seats[i];
    for (const MassElement& element : model.tree.bodies[i].elements) {
      elements[static_cast<std::size_t>(seat.link)].push_back(seated(element, seat));
    }
  }
  return elements;
}

void restore_exact_masses(const BodyTree& tree, mjModel& loaded) {
  bool changed = false;
  for (const TreeBody& body : tree.bodies) {
    changed = changed || body.tank >= 0;  // it will
    const int id = find(loaded, mjOBJ_BODY, body.name);
    Eigen::Map<Vector3d> inertia(loaded.body_inertia + 3 * id);
    // An eigenvalue of a rod can come out a rounding below zero.
    const Vector3d moments = told_inertia(body.inertial).moments.cwiseMax(0.0);
    if (loaded.body_mass[id] == body.inertial.mass && inertia == moments) continue;
    loaded.body_mass[id] = body.inertial.mass;
    inertia = moments;
    changed = true;
  }
  // MuJoCo keeps the mass matrix of "simple" degrees of freedom from the time of loading.
  if (changed) std::fill_n(loaded.dof_simplenum, loaded.nv, 0);
}

}  // namespace twincraft
