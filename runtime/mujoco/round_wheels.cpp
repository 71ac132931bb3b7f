// See round_wheels.h.
#include "runtime/mujoco/round_wheels.h"

#include <algorithm>
#include <map>

namespace twincraft {
namespace {

bool is_exact(const TreeBody& wheel) {
  const Matrix3d& I = wheel.inertial.I_PntC_L;
  return wheel.parent == 0 && I == Matrix3d(I.diagonal().asDiagonal()) &&
         wheel.quat.coeffs() == Quaterniond::Identity().coeffs();
}

void set_inertia(int body, const Matrix3d& I, mjModel& loaded) {
  const PrincipalInertia principal = principal_inertia(I);
  Eigen::Map<Vector3d>(loaded.body_inertia + 3 * body) = principal.moments;
  const Quaterniond& axes = principal.axes;
  Eigen::Map<Eigen::Vector4d>(loaded.body_iquat + 4 * body) << axes.w(), axes.vec();
  loaded.body_sameframe[body] = 0;  // or MuJoCo would go on with the axes of the time of loading
}

}  // namespace

std::vector<int> make_wheels_round(const BodyTree& tree, mjModel& loaded) {
  const auto id_of = [&loaded](const TreeBody& body) {
    return mj_name2id(&loaded, mjOBJ_BODY, body.name.c_str());
  };
  std::vector<int> wheels;
  std::map<int, Matrix3d> mounts;  // of the tree: what their inertias become
  for (const TreeBody& body : tree.bodies) {
    if (body.link >= 0 || body.joints.empty() || is_exact(body)) continue;
    const Vector3d& axis = body.joints.front().axis;
    const Matrix3d& I = body.inertial.I_PntC_L;
    const Matrix3d all_round = axis.dot(I * axis) * Matrix3d::Identity();
    const Matrix3d turn = body.quat.toRotationMatrix();
    const TreeBody& mount = tree.bodies[static_cast<std::size_t>(body.parent)];
    Matrix3d& carried = mounts.try_emplace(body.parent, mount.inertial.I_PntC_L).first->second;
    carried += turn * (I - all_round) * turn.transpose();
    wheels.push_back(id_of(body));
    set_inertia(wheels.back(), all_round, loaded);
  }
  for (const auto& [index, I] : mounts)
    set_inertia(id_of(tree.bodies[static_cast<std::size_t>(index)]), 0.5 * (I + I.transpose()),
                loaded);
  // MuJoCo keeps the mass matrix of "simple" degrees of freedom from the time of loading.
  if (!wheels.empty()) std::fill_n(loaded.dof_simplenum, loaded.nv, 0);
  return wheels;
}

void align_round_wheels(const std::vector<int>& bodies, mjData& data) {
  for (const int body : bodies) Eigen::Map<Matrix3d>(data.ximat + 9 * body) = Matrix3d::Identity();
}

}  // namespace twincraft
