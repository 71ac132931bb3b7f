// Rotations found from directions and from matrices that are nearly rotations.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace twincraft {

/// The shortest rotation that takes the direction of `from` to that of `to`. Neither is zero.
Eigen::Quaterniond shortest_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// The rotation matrix nearest to `m` in the Frobenius norm, or the nearest reflection when its
/// determinant is negative.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& m);

}  // namespace twincraft
