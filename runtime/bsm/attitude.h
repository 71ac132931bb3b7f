// Attitude charts of the analytic engine: rotation matrix, kinematics, and what keeps the chart
// regular after a step. Schaub and Junkins, Analytical Mechanics of Space Systems, chapter 3.
// Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include <cmath>

#include "compiler/ir/mass.h"

namespace twincraft::bsm {

/// Modified Rodrigues parameters sigma_BN: three numbers, switched to their shadow outside the
/// unit ball.
struct MrpChart {
  using Coordinates = Vector3d;

  static Matrix3d dcm_NB(const Vector3d& sigma) {
    const double s2 = sigma.squaredNorm();
    const double inverse = 1.0 / ((1.0 + s2) * (1.0 + s2));
    // 1 + 8 sigma~ sigma~ / (1 + s2)^2 + 4 (1 - s2) sigma~ / (1 + s2)^2, with
    // sigma~ sigma~ = sigma sigma^T - s2 1.
    Matrix3d dcm = (8.0 * inverse * sigma) * sigma.transpose();
    dcm.diagonal().array() += 1.0 - 8.0 * inverse * s2;
    return dcm + tilde((4.0 * (1.0 - s2) * inverse) * sigma);
  }

  /// sigmaDot = 1/4 [(1 - sigma^2) 1 + 2 sigma~ + 2 sigma sigma^T] omega
  static Vector3d rate(const Vector3d& sigma, const Vector3d& omega_BN_B) {
    return 0.25 * ((1.0 - sigma.squaredNorm()) * omega_BN_B + 2.0 * sigma.cross(omega_BN_B) +
                   (2.0 * sigma.dot(omega_BN_B)) * sigma);
  }

  static Vector3d regular(const Vector3d& sigma) {
    const double s2 = sigma.squaredNorm();
    return s2 > 1.0 ? Vector3d(-sigma / s2) : sigma;
  }

  static Vector3d from(const Quaterniond& q_BN) {
    // Scalar not negative keeps the result inside the unit ball.
    const double sign = q_BN.w() < 0.0 ? -1.0 : 1.0;
    return sign * q_BN.vec() / (1.0 + sign * q_BN.w());
  }

  static Quaterniond quaternion(const Vector3d& sigma) {
    const double s2 = sigma.squaredNorm();
    const Vector3d vec = (2.0 / (1.0 + s2)) * sigma;
    return {(1.0 - s2) / (1.0 + s2), vec.x(), vec.y(), vec.z()};
  }
};

/// Quaternion, scalar first, B to N: four numbers with their rate, normalised after a step. Within
/// a step it is read as if normalised, by its own rate too: the error of a step is then a third of
/// what the rate of a stage off the unit sphere leaves.
struct QuaternionChart {
  using Coordinates = Eigen::Vector4d;

  static Matrix3d dcm_NB(const Eigen::Vector4d& q) { return quaternion(q).toRotationMatrix(); }

  /// qDot = 1/2 q (0, omega)
  static Eigen::Vector4d rate(const Eigen::Vector4d& q, const Vector3d& omega_BN_B) {
    const Vector3d half = (0.5 / q.norm()) * omega_BN_B;
    const Vector3d vec = q.tail<3>();
    Eigen::Vector4d rate;
    rate[0] = -vec.dot(half);
    rate.tail<3>() = q[0] * half + vec.cross(half);
    return rate;
  }

  static Eigen::Vector4d regular(const Eigen::Vector4d& q) { return q / q.norm(); }

  static Eigen::Vector4d from(const Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

  static Quaterniond quaternion(const Eigen::Vector4d& q) {
    return Quaterniond(q[0], q[1], q[2], q[3]).normalized();
  }
};

}  // namespace twincraft::bsm
