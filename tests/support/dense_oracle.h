// The same machine solved the plain way: dense mass matrix, all biases, one Cholesky. Shares no
// equation with the recursion: Kane's method over every mass element, wheels as spinning bodies.
#pragma once

#include <random>
#include <span>

#include "compiler/ir/model.h"

namespace twincraft::test {

struct OracleState {
  Vector3d omega_BN_B;
  std::vector<double> q, q_dot, rotor_speed;
};

/// (a_B in hub axes, omegaDot, qDDot, wheel rates) of a vehicle with held efforts and torques and a
/// force [N] and torque [N m] about each link's origin, in that link's axes.
Eigen::VectorXd dense_accelerations(const Assembly& assembly, const OracleState& state,
                                    const std::vector<Vector3d>& force_L,
                                    const std::vector<Vector3d>& torque_L);

/// A random tree with hinges, slides, rotors, offset masses and full tensors.
Assembly random_assembly(std::mt19937_64& random, int joints, int rotors);
OracleState random_state(std::mt19937_64& random, const Assembly& assembly);
Vector3d random_vector(std::mt19937_64& random, double size);

}  // namespace twincraft::test
