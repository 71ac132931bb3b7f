// Decides the generalised forces of wrenches: q_i = cdof_i . (sum of the wrenches outboard of dof
// i). MuJoCo's cdof are spatial vectors (angular part first) about the centre of mass of the whole
// tree, so the wrenches are moved there first. Tested by tests/runtime/mujoco_test.cpp.
#include "runtime/mujoco/wrenches.h"

#include <algorithm>

namespace twincraft {

using Vector6d = Eigen::Matrix<double, 6, 1>;

WrenchProjector::WrenchProjector(const mjModel& model, const TreeMap& map)
    : link_body_(map.link_body), subtree_(static_cast<std::size_t>(model.nbody)) {}

void WrenchProjector::add(const mjModel& model, const mjData& data,
                          std::span<const Wrench> wrenches, std::span<double> generalised) {
  using Point = Eigen::Map<const Vector3d>;
  const Vector3d r_CB_W = Point(data.subtree_com + 3 * kHubBody) - Point(data.xpos + 3 * kHubBody);
  std::fill(subtree_.begin(), subtree_.end(), Vector6d::Zero());
  for (std::size_t link = 0; link < wrenches.size(); ++link) {
    const Wrench& wrench = wrenches[link];
    Vector6d& sum = subtree_[static_cast<std::size_t>(link_body_[link])];
    sum.head<3>() += wrench.torque_PntB_W - r_CB_W.cross(wrench.force_W);
    sum.tail<3>() += wrench.force_W;
  }
  for (int body = model.nbody - 1; body > kHubBody; --body) {
    subtree_[static_cast<std::size_t>(model.body_parentid[body])] +=
        subtree_[static_cast<std::size_t>(body)];
  }
  for (int i = 0; i < model.nv; ++i) {
    const Eigen::Map<const Vector6d> axis(data.cdof + 6 * i);
    generalised[static_cast<std::size_t>(i)] +=
        axis.dot(subtree_[static_cast<std::size_t>(model.dof_bodyid[i])]);
  }
}

}  // namespace twincraft
