// See motion.h. Tested by tests/runtime/bsm_test.cpp.
#include "runtime/bsm/motion.h"

#include <cmath>

namespace twincraft::bsm {

Motion motion_of(const Tree& tree, std::span<const double> q, std::span<const double> q_dot,
                 const Vector3d& omega_BN_B) {
  Motion motion{{{Matrix3d::Identity(), Vector3d::Zero()}}, {{omega_BN_B, Vector3d::Zero()}}};
  for (std::size_t i = 1; i < tree.links.size(); ++i) {
    const LinkConstants& link = tree.links[i];
    const auto p = static_cast<std::size_t>(link.parent);
    const LinkPose& parent = motion.poses[p];
    const Vector3d axis = parent.dcm_WL * link.axis_P;
    Vector3d r_HP = parent.dcm_WL * link.r_HP_P;
    Matrix3d dcm_PL = link.turn_fixed;
    LinkRate rate = motion.rates[p];
    if (link.kind == JointKind::kHinge) {
      dcm_PL += std::cos(q[i - 1]) * link.turn_cos + std::sin(q[i - 1]) * link.turn_sin;
      rate.v_LN_W += rate.omega_LN_W.cross(r_HP);
      rate.omega_LN_W += q_dot[i - 1] * axis;
    } else {
      r_HP += q[i - 1] * axis;
      rate.v_LN_W += rate.omega_LN_W.cross(r_HP) + q_dot[i - 1] * axis;
    }
    const Matrix3d dcm_WL = parent.dcm_WL * dcm_PL;
    const Vector3d r_LB_W = parent.r_LB_W + r_HP;
    motion.poses.push_back({dcm_WL, r_LB_W});
    motion.rates.push_back(rate);
  }
  return motion;
}

}  // namespace twincraft::bsm
