// See motion.h. Tested by tests/runtime/bsm_test.cpp.
#include "runtime/bsm/motion.h"

#include <cmath>

namespace twincraft::bsm {

Motion at_rest(const Tree& tree) {
  return {std::vector<LinkPose>(tree.links.size(), {Matrix3d::Identity(), Vector3d::Zero()}),
          std::vector<LinkRate>(tree.links.size(), {Vector3d::Zero(), Vector3d::Zero()})};
}

void move_link(const Tree& tree, std::size_t i, std::span<const double> q,
               std::span<const double> q_dot, Motion& motion) {
  const LinkConstants& link = tree.links[i];
  const bool on_hub = link.parent == 0;  // whose axes are the working axes
  const auto p = static_cast<std::size_t>(link.parent);
  const LinkPose& parent = motion.poses[p];
  const Vector3d axis = on_hub ? link.axis_P : Vector3d(parent.dcm_WL * link.axis_P);
  Vector3d r_HP = on_hub ? link.r_HP_P : Vector3d(parent.dcm_WL * link.r_HP_P);
  Matrix3d dcm_PL = link.turn_fixed;
  LinkRate& rate = motion.rates[i];
  rate = motion.rates[p];
  if (link.kind == JointKind::kHinge) {
    dcm_PL += std::cos(q[i - 1]) * link.turn_cos + std::sin(q[i - 1]) * link.turn_sin;
    rate.v_LB_W += rate.omega_LN_W.cross(r_HP);
    rate.omega_LN_W += q_dot[i - 1] * axis;
  } else {
    r_HP += q[i - 1] * axis;
    rate.v_LB_W += rate.omega_LN_W.cross(r_HP) + q_dot[i - 1] * axis;
  }
  if (on_hub)
    motion.poses[i] = {dcm_PL, r_HP};
  else
    motion.poses[i] = {parent.dcm_WL * dcm_PL, parent.r_LB_W + r_HP};
}

void move_links(const Tree& tree, std::span<const double> q, std::span<const double> q_dot,
                const Vector3d& omega_BN_B, Motion& motion) {
  motion.rates.front().omega_LN_W = omega_BN_B;
  for (std::size_t i = 1; i < tree.links.size(); ++i) move_link(tree, i, q, q_dot, motion);
}

Motion motion_of(const Tree& tree, std::span<const double> q, std::span<const double> q_dot,
                 const Vector3d& omega_BN_B) {
  Motion motion = at_rest(tree);
  move_links(tree, q, q_dot, omega_BN_B, motion);
  return motion;
}

}  // namespace twincraft::bsm
