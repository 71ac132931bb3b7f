// See mujoco_inertial.h.
#include "compiler/emit/mujoco_inertial.h"

#include <algorithm>

#include "compiler/ir/body_tree.h"

namespace twincraft {
namespace {

constexpr double kLeastMass = 1.0e-15;  // [kg] and [kg m^2]; MuJoCo's mjMINVAL

// The moments MuJoCo accepts that are nearest to the given ones.
Vector3d acceptable(const Vector3d& moments) {
  Vector3d accepted = moments.cwiseMax(kLeastMass);
  Eigen::Index largest = 0;
  accepted.maxCoeff(&largest);
  const double others = accepted[(largest + 1) % 3] + accepted[(largest + 2) % 3];
  accepted[largest] = std::min(accepted[largest], others);
  return accepted;
}

}  // namespace

MujocoInertial mujoco_inertial(const MassProperties& properties) {
  PrincipalInertia principal = told_inertia(properties);
  principal.moments = acceptable(principal.moments);
  return {std::max(properties.mass, kLeastMass), properties.r_CL_L, principal};
}

}  // namespace twincraft
