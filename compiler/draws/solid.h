// What turns and spreads in space: directions, attitudes and inertias about their nominal values.
// Tested by tests/compiler/draws_test.cpp.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace twincraft::draws {

/// The rotation about the direction of `turn` by its length [rad].
Eigen::Quaterniond rotation_of(const Eigen::Vector3d& turn);

/// The unit vector `axis` tilted by `tilts` [rad], along two directions across it that depend on
/// `axis` alone.
Eigen::Vector3d tilted(const Eigen::Vector3d& axis, const Eigen::Vector2d& tilts);

/// An inertia tensor whose second moments of mass, the eigenvalues of Sigma = tr(I) / 2 - I, are
/// multiplied by `factors`, and that is then turned by `turn` [rad]. As these moments stay positive
/// some body has the result. @param inertia  about the centre of mass [kg m^2]
Eigen::Matrix3d spread(const Eigen::Matrix3d& inertia, const Eigen::Vector3d& factors,
                       const Eigen::Vector3d& turn);

}  // namespace twincraft::draws
