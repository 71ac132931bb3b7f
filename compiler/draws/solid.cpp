// See solid.h.
#include "compiler/draws/solid.h"

#include <cmath>

#include "compiler/draws/arithmetic.h"
#include "compiler/ir/mass.h"

namespace twincraft::draws {

using Eigen::Vector2d;

Quaterniond rotation_of(const Vector3d& turn) {
  const double angle = std::sqrt(turn.squaredNorm());
  if (angle == 0.0) return Quaterniond::Identity();
  const SineCosine half = sine_cosine(angle / 2.0);
  const Vector3d vector = turn * (half.sine / angle);
  return {half.cosine, vector.x(), vector.y(), vector.z()};
}

Vector3d tilted(const Vector3d& axis, const Vector2d& tilts) {
  const double angle = std::sqrt(tilts.squaredNorm());
  if (angle == 0.0) return axis;
  Eigen::Index smallest = 0;
  axis.cwiseAbs().minCoeff(&smallest);
  const Vector3d first = axis.cross(Vector3d::Unit(smallest)).normalized();
  const Vector3d second = axis.cross(first);
  const SineCosine turn = sine_cosine(angle);
  const Vector3d across = (first * tilts[0] + second * tilts[1]) / angle;
  return (axis * turn.cosine + across * turn.sine).normalized();
}

Matrix3d spread(const Matrix3d& inertia, const Vector3d& factors, const Vector3d& turn) {
  const PrincipalInertia principal = principal_inertia(inertia);
  const Vector3d half_trace = Vector3d::Constant(principal.moments.sum() / 2.0);
  // A flat plate has none across it; what rounding leaves below zero is none either.
  const Vector3d second = (half_trace - principal.moments).cwiseMax(0.0).cwiseProduct(factors);
  const Vector3d moments(second.y() + second.z(), second.x() + second.z(), second.x() + second.y());
  const Matrix3d axes = (rotation_of(turn) * principal.axes).toRotationMatrix();
  const Matrix3d result = axes * moments.asDiagonal() * axes.transpose();
  return (result + result.transpose()) / 2.0;
}

}  // namespace twincraft::draws
