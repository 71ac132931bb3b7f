// See tree.h. Tested by tests/runtime/bsm_test.cpp.
#include "runtime/bsm/tree.h"

namespace twincraft::bsm {
namespace {

void prepare_joint(const Joint& joint, LinkConstants& link) {
  link.kind = joint.kind;
  link.r_HP_P = joint.r_HP_P;
  link.axis_P = joint.dcm_PL0 * joint.axis_L;
  link.stiffness = joint.stiffness;
  link.damping = joint.damping;
  link.rest = joint.rest;
  if (joint.kind == JointKind::kSlide) {
    link.turn_fixed = joint.dcm_PL0;
    link.turn_cos = link.turn_sin = Matrix3d::Zero();
    return;
  }
  const Matrix3d along = joint.axis_L * joint.axis_L.transpose();
  link.turn_fixed = joint.dcm_PL0 * along;
  link.turn_cos = joint.dcm_PL0 * (Matrix3d::Identity() - along);
  link.turn_sin = joint.dcm_PL0 * tilde(joint.axis_L);
}

void prepare_mass(const Link& link, const Matrix3d& rotor_inertia, LinkConstants& constants) {
  Matrix3d J = -rotor_inertia;
  constants.first_moment.setZero();
  for (const MassElement& element : link.elements) {
    constants.mass += element.mass;
    constants.first_moment += element.mass * element.r_EL_L;
    J += parallel_axis(element.I_PntE_L, element.mass, element.r_EL_L);
  }
  constants.J_L = Sym3::from(J);
}

/// Axial inertia of all rotors on a link, as a tensor in its axes.
Matrix3d rotor_inertia_on(int link, const std::vector<Rotor>& rotors) {
  Matrix3d sum = Matrix3d::Zero();
  for (const Rotor& rotor : rotors) {
    if (rotor.link == link) sum += rotor.spin_inertia * rotor.axis_L * rotor.axis_L.transpose();
  }
  return sum;
}

}  // namespace

Tree prepare(const Assembly& assembly) {
  Tree tree;
  for (const Link& link : assembly.links) {
    const auto index = static_cast<int>(tree.links.size());
    LinkConstants& constants = tree.links.emplace_back();
    constants.parent = link.parent;
    prepare_joint(link.joint, constants);
    prepare_mass(link, rotor_inertia_on(index, assembly.rotors), constants);
  }
  for (const Rotor& rotor : assembly.rotors) {
    tree.rotors.push_back({rotor.link, rotor.axis_L, rotor.spin_inertia});
  }
  return tree;
}

}  // namespace twincraft::bsm
