// The mass matrix of the analytic engine, for proofs: no step forms it.
// Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include "runtime/bsm/motion.h"

namespace twincraft::bsm {

/// Over (v_B in N, omega in B, qDot, wheel speeds), summed from partial velocities.
Eigen::MatrixXd dense_mass_matrix(const Tree& tree, const Motion& motion, const Matrix3d& dcm_NB);

}  // namespace twincraft::bsm
