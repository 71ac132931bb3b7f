// What accelerations are measured by. Those of one kind of coordinate are a block, and each is
// relative to the largest of its block, never to less than what turning alone makes of it.
// Tested by tests/runtime/proof_test.cpp.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "compiler/ir/model.h"

namespace twincraft {

/// A block of the velocity coordinates (v_B in N, omega in B, joint rates, wheel rates).
struct AccelerationBlock {
  std::string what;
  std::vector<std::string> names;
  std::vector<int> entries;  // of the acceleration vector
  double floor = 0.0;        // smallest magnitude worth comparing with
};

/// The blocks that a vehicle has. @param M  its mass matrix in some state
std::vector<AccelerationBlock> acceleration_blocks(const Model& model, const Eigen::MatrixXd& M);

/// Radius of gyration about B [m] from the hub blocks of a mass matrix.
double gyration_radius(const Eigen::MatrixXd& M);

}  // namespace twincraft
