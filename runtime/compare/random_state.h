// Physical states to compare engines at, drawn once and then written in each engine's own chart.
// The generator and the mapping to numbers are ours, so that a state is the same on every machine.
// Tested by tests/runtime/proof_test.cpp.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "compiler/ir/model.h"

namespace twincraft {

struct StateLayout;

/// Of random_states(), the same everywhere.
inline constexpr std::uint64_t kStateSeed = 20240229;

/// The scalar of q_BN is not negative.
struct RandomState : VehicleState {
  double time = 0.0;  // [s] whose inputs are held
};

/// Random attitudes, rates about 0.1 rad/s, hinges about 0.5 rad and slides about 0.05 m off their
/// start, wheels to 100 rad/s, times anywhere in the run; position and velocity as at the start. A
/// point mass, which has nothing else, is moved by up to a tenth of its distance.
std::vector<RandomState> random_states(const Model& model, int count);

/// The start of the run itself, turned so that B and N agree.
RandomState undisturbed(const Model& model);

/// Of a state's derivative, what belongs to (v_B in N, omega in B, joint rates, wheel rates).
Eigen::VectorXd accelerations_of(const Eigen::VectorXd& rate, const StateLayout& layout);

}  // namespace twincraft
