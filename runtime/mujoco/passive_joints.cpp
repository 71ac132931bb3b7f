// See passive_joints.h.
#include "runtime/mujoco/passive_joints.h"

#include <cmath>

namespace twincraft {

PassiveJoints::PassiveJoints(const Assembly& assembly, const TreeMap& map, const mjModel& loaded) {
  for (std::size_t i = 0; i < map.joint_dof.size(); ++i) {
    const int dof = map.joint_dof[i], qpos = map.joint_qpos[i];
    const int cosine = assembly.links[i + 1].joint.damped_by_cosine_of;
    joints_.push_back({qpos, dof, loaded.jnt_stiffness[loaded.dof_jntid[dof]],
                       loaded.dof_damping[dof], loaded.qpos_spring[qpos],
                       cosine < 0 ? -1 : map.joint_qpos[static_cast<std::size_t>(cosine) - 1]});
  }
}

double PassiveJoints::damping_of(const Joint& joint, const mjData& data) {
  if (joint.cosine_qpos < 0) return joint.damping;
  const double cosine = std::cos(data.qpos[joint.cosine_qpos]);
  return joint.damping * cosine * cosine;
}

void PassiveJoints::apply(mjData& data) const {
  for (const Joint& joint : joints_) {
    const double stretch = data.qpos[joint.qpos] - joint.rest;
    data.qfrc_passive[joint.dof] =
        -joint.stiffness * stretch - damping_of(joint, data) * data.qvel[joint.dof];
  }
}

double PassiveJoints::spring_energy(const mjData& data) const {
  double energy = 0.0;
  for (const Joint& joint : joints_) {
    const double stretch = data.qpos[joint.qpos] - joint.rest;
    energy += 0.5 * joint.stiffness * stretch * stretch;
  }
  return energy;
}

double PassiveJoints::damper_power(const mjData& data) const {
  double power = 0.0;
  for (const Joint& joint : joints_) {
    const double speed = data.qvel[joint.dof];
    power += damping_of(joint, data) * speed * speed;
  }
  return power;
}

}  // namespace twincraft
