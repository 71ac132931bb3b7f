// Physical states to compare engines at, drawn once and then written in each engine's own chart.
// The generator and the mapping to numbers are ours, so that a state is the same on every machine.
// Tested by tests/runtime/proof_test.cpp.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/engine/state.h"

namespace twincraft {

struct RandomState {
  double time = 0.0;  // [s] whose inputs are held
  Vector3d r_BN_N, v_BN_N;
  Quaterniond q_BN;  // scalar not negative
  Vector3d omega_BN_B;
  std::vector<double> joint_position, joint_rate, wheel_rate;
};

/// Random attitudes, rates about 0.1 rad/s, hinges about 0.5 rad and slides about 0.05 m off their
/// start, wheels to 100 rad/s, times anywhere in the run; position and velocity as at the start. A
/// point mass, which has nothing else, is moved by up to a tenth of its distance.
std::vector<RandomState> random_states(const Model& model, int count);

/// The start of the run itself, turned so that B and N agree.
RandomState undisturbed(const Model& model);

/// `state` as the entries of a state vector.
Eigen::VectorXd state_vector(const RandomState& state, const StateLayout& layout);

/// Of a state's derivative, what belongs to (v_B in N, omega in B, joint rates, wheel rates).
Eigen::VectorXd accelerations_of(const Eigen::VectorXd& rate, const StateLayout& layout);

}  // namespace twincraft
