// Decides the generalised forces of wrenches: the sum of the wrenches outboard of a dof, along that
// dof. The free joint takes the force in world axes and the torque about the hub origin in hub
// axes as they are. For joints MuJoCo's cdof are spatial vectors (angular part first) about the
// centre of mass of the whole tree, so the wrench is moved there.
// Tested by tests/runtime/mujoco_test.cpp.
#include "runtime/mujoco/wrenches.h"

#include <algorithm>

namespace twincraft {

namespace {

void accumulate(const Wrench& wrench, Wrench& sum) {
  sum.force_W += wrench.force_W;
  sum.torque_PntB_W += wrench.torque_PntB_W;
}

}  // namespace

WrenchProjector::WrenchProjector(const mjModel& model, const TreeMap& map)
    : link_body_(map.link_body), subtree_(static_cast<std::size_t>(model.nbody)) {}

void WrenchProjector::add(const mjModel& model, const mjData& data,
                          std::span<const Wrench> wrenches, std::span<double> generalised) {
  using Point = Eigen::Map<const Vector3d>;
  std::fill(subtree_.begin(), subtree_.end(), Wrench{});
  for (std::size_t link = 0; link < wrenches.size(); ++link) {
    accumulate(wrenches[link], subtree_[static_cast<std::size_t>(link_body_[link])]);
  }
  for (int body = model.nbody - 1; body > kHubBody; --body) {
    accumulate(subtree_[static_cast<std::size_t>(body)],
               subtree_[static_cast<std::size_t>(model.body_parentid[body])]);
  }
  using Rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
  const Wrench& all = subtree_[kHubBody];
  Eigen::Map<Vector3d>(generalised.data()) += all.force_W;
  Eigen::Map<Vector3d>(generalised.data() + 3) +=
      Rotation(data.xmat + 9 * kHubBody).transpose() * all.torque_PntB_W;
  const Vector3d r_CB_W = Point(data.subtree_com + 3 * kHubBody) - Point(data.xpos + 3 * kHubBody);
  for (int i = kHubDofs; i < model.nv; ++i) {
    const Wrench& outboard = subtree_[static_cast<std::size_t>(model.dof_bodyid[i])];
    const Point angular(data.cdof + 6 * i), linear(data.cdof + 6 * i + 3);
    generalised[static_cast<std::size_t>(i)] +=
        angular.dot(outboard.torque_PntB_W - r_CB_W.cross(outboard.force_W)) +
        linear.dot(outboard.force_W);
  }
}

}  // namespace twincraft
