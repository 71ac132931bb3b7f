// Attitude charts outside a step: to and from the quaternion of a report. What a step needs of them
// is in charts.h. Schaub and Junkins, Analytical Mechanics of Space Systems, chapter 3.
// Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include "compiler/ir/mass.h"

namespace twincraft {

/// sigma_BN of a rotation, inside the unit ball.
inline Vector3d mrp_from(const Quaterniond& q_BN) {
  const double sign = q_BN.w() < 0.0 ? -1.0 : 1.0;
  return sign * q_BN.vec() / (1.0 + sign * q_BN.w());
}

inline Quaterniond quaternion_from(const Vector3d& sigma_BN) {
  const double s2 = sigma_BN.squaredNorm();
  const Vector3d vec = (2.0 / (1.0 + s2)) * sigma_BN;
  return {(1.0 - s2) / (1.0 + s2), vec.x(), vec.y(), vec.z()};
}

}  // namespace twincraft
