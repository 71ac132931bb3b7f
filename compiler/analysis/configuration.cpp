// Forward kinematics from the hub outward. Tested by tests/compiler/configuration_test.cpp.
#include "compiler/analysis/configuration.h"

namespace twincraft {
namespace {

LinkMotion moved(const LinkMotion& parent, const Joint& joint, double q, double qDot) {
  const Matrix3d dcm_BL0 = parent.dcm_BL * joint.dcm_PL0;
  const Vector3d axis_B = dcm_BL0 * joint.axis_L;  // a joint leaves its own axis where it is
  LinkMotion link;
  link.dcm_BL = dcm_BL0;
  link.r_LB_B = parent.r_LB_B + parent.dcm_BL * joint.r_HP_P;
  link.omega_LB_B = parent.omega_LB_B;
  if (joint.kind == JointKind::kHinge) {
    link.dcm_BL = dcm_BL0 * Eigen::AngleAxisd(q, joint.axis_L).toRotationMatrix();
    link.omega_LB_B += qDot * axis_B;
  } else {
    link.r_LB_B += q * axis_B;
  }
  link.v_LB_B = parent.v_LB_B + parent.omega_LB_B.cross(link.r_LB_B - parent.r_LB_B);
  if (joint.kind == JointKind::kSlide) link.v_LB_B += qDot * axis_B;
  return link;
}

}  // namespace

std::vector<LinkMotion> configuration(const Assembly& assembly, std::span<const double> q,
                                      std::span<const double> qDot) {
  std::vector<LinkMotion> links(assembly.links.size());
  for (std::size_t i = 1; i < links.size(); ++i) {
    const Link& link = assembly.links[i];
    const LinkMotion& parent = links[static_cast<std::size_t>(link.parent)];
    links[i] = moved(parent, link.joint, q[i - 1], qDot[i - 1]);
  }
  return links;
}

MassProperties system_properties(const Assembly& assembly, std::span<const LinkMotion> links) {
  MassProperties total;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const LinkMotion& link = links[i];
    for (const MassElement& element : assembly.links[i].elements) {
      const Vector3d r_EB_B = link.r_LB_B + link.dcm_BL * element.r_EL_L;
      const Matrix3d I_PntE_B = link.dcm_BL * element.I_PntE_L * link.dcm_BL.transpose();
      total = total + MassProperties{element.mass, r_EB_B, I_PntE_B};
    }
  }
  return total;
}

Vector3d center_of_mass_rate(const Assembly& assembly, std::span<const LinkMotion> links) {
  double mass = 0.0;
  Vector3d momentum = Vector3d::Zero();
  for (std::size_t i = 0; i < links.size(); ++i) {
    const LinkMotion& link = links[i];
    for (const MassElement& element : assembly.links[i].elements) {
      const Vector3d arm_B = link.dcm_BL * element.r_EL_L;
      momentum += element.mass * (link.v_LB_B + link.omega_LB_B.cross(arm_B));
      mass += element.mass;
    }
  }
  return momentum / mass;
}

}  // namespace twincraft
