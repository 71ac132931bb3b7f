#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "compiler/ir/mass.h"

namespace twincraft {

inline constexpr double kDegrees = 180.0 / std::numbers::pi;  // [deg/rad]

/// Angle [rad] of the rotation between two attitudes, in [0, pi]; keeps its relative accuracy down
/// to rotations of about 1e-16 rad, where the arc cosine of the scalar part knows nothing.
inline double principal_angle(const Quaterniond& a, const Quaterniond& b) {
  const Vector3d vec = a.w() * b.vec() - b.w() * a.vec() - a.vec().cross(b.vec());
  const double scalar = a.w() * b.w() + a.vec().dot(b.vec());
  return 2.0 * std::atan2(vec.norm(), std::abs(scalar));
}

}  // namespace twincraft
