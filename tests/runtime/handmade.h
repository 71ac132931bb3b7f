// Trajectories written by hand, for tests of what is made of trajectories.
#pragma once

#include "compiler/ir/model.h"
#include "runtime/simulate/propagate.h"

namespace twincraft::test {

/// A hub with panel `wing` of two segments, jointed `arm` (angle) and `rail` (displacement),
/// particle `slosh`, pendulum `bob.phi`, `bob.theta`, and wheels `rw_x`, `rw_y`.
inline Model model_of_every_kind() {
  using Kind = Coordinate::Kind;
  Model model;
  model.name = "every_kind";
  model.coordinates = {{"rw_x", Kind::kWheel, 0},        {"rw_y", Kind::kWheel, 1},
                       {"wing.1", Kind::kPanel, 1},      {"wing.2", Kind::kPanel, 2},
                       {"arm", Kind::kBodyAngle, 3},     {"rail", Kind::kBodyDisplacement, 4},
                       {"slosh", Kind::kParticle, 5},    {"bob.phi", Kind::kPendulum, 6},
                       {"bob.theta", Kind::kPendulum, 7}};
  model.assembly.links.resize(8);
  model.assembly.rotors.resize(2);
  model.simulation.duration = 1.0;
  model.simulation.step = 0.5;
  return model;
}

inline Observation sample_at(double time, const Model& model) {
  Observation sample;
  sample.time = time;
  sample.r_BN_N = sample.v_BN_N = sample.r_CN_N = sample.v_CN_N = Vector3d::Zero();
  sample.omega_BN_B = sample.momentum = sample.H_PntC_N = Vector3d::Zero();
  sample.q_BN = Quaterniond::Identity();
  sample.joint_position.assign(model.assembly.links.empty() ? 0 : model.assembly.links.size() - 1,
                               0.0);
  sample.joint_rate = sample.joint_position;
  sample.wheel_rate.assign(model.assembly.rotors.size(), 0.0);
  sample.mass = 100.0;
  return sample;
}

/// Three samples at 0, 0.5 and 1 s in which nothing happens.
inline Trajectory standstill(const Model& model) {
  Trajectory trajectory;
  for (double time : {0.0, 0.5, 1.0}) {
    trajectory.samples.push_back(sample_at(time, model));
    trajectory.books.emplace_back();
  }
  trajectory.t_end = 1.0;
  trajectory.counts.accepted = 2;
  trajectory.counts.evaluations = 8;
  return trajectory;
}

}  // namespace twincraft::test
