#include "compiler/ir/rotation.h"

#include <Eigen/SVD>
#include <cmath>

namespace twincraft {

Eigen::Quaterniond shortest_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  // As Eigen's FromTwoVectors, which finds the axis of a half turn by a decomposition that takes
  // six seconds to compile.
  constexpr double kHalfTurn = 1.0e-12;  // so near to it the cross product is rounding
  const Eigen::Vector3d start = from.normalized(), end = to.normalized();
  const double cosine = end.dot(start);
  Eigen::Quaterniond rotation;
  if (cosine < -1.0 + kHalfTurn) {
    rotation.w() = 0.0;
    rotation.vec() = start.unitOrthogonal().cross(start);  // any axis across both
    return rotation;
  }
  const double s = std::sqrt((1.0 + cosine) * 2.0);
  rotation.w() = s * 0.5;
  rotation.vec() = start.cross(end) * (1.0 / s);
  return rotation;
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

}  // namespace twincraft
