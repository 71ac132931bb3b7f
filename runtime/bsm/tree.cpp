// See tree.h. Tested by tests/runtime/bsm_test.cpp.
#include "runtime/bsm/tree.h"

#include <algorithm>
#include <utility>

namespace twincraft::bsm {
namespace {

/// @param s  unit. Exact where s is a coordinate axis.
Matrix3d axes_with_third(const Vector3d& s) {
  Matrix3d dcm_LK;
  const Vector3d x = s.unitOrthogonal();
  dcm_LK << x, s.cross(x), s;
  return dcm_LK;
}

void prepare_joint(const Joint& joint, LinkConstants& link) {
  link.kind = joint.kind;
  link.r_HP_P = joint.r_HP_P;
  link.axis_P = joint.dcm_PL0 * joint.axis_L;
  const Matrix3d dcm_LK = axes_with_third(joint.axis_L);
  link.dcm_KL = dcm_LK.transpose();
  link.dcm_PK0 = joint.dcm_PL0 * dcm_LK;
  link.stiffness = joint.stiffness;
  link.damping = joint.damping;
  link.damped_by_cosine_of = joint.damped_by_cosine_of;
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

void add(const MassElement& element, MassSums& sums) {
  sums.mass += element.mass;
  sums.first_moment += element.mass * element.r_EL_L;
  sums.J_L += parallel_axis(element.I_PntE_L, element.mass, element.r_EL_L);
}

void put(const MassSums& sums, LinkConstants& link) {
  link.mass = sums.mass;
  link.first_moment = sums.first_moment;
  link.J_L = sums.J_L;
}

/// The sums of one tank's elements on a link, begun when first asked for.
MassSums& part_of(std::size_t tank, Draining& draining) {
  for (Draining::Part& part : draining.parts) {
    if (part.tank == tank) return part.full;
  }
  return draining.parts.emplace_back(Draining::Part{tank, {}}).full;
}

void prepare_mass(const Link& link, std::size_t index, const Matrix3d& rotor_inertia, Tree& tree) {
  Draining draining;
  draining.link = index;
  draining.fixed.J_L = -rotor_inertia;
  for (const MassElement& element : link.elements) {
    if (element.tank < 0) {
      add(element, draining.fixed);
      continue;
    }
    const auto tank = static_cast<std::size_t>(element.tank);
    tree.tanks = std::max(tree.tanks, tank + 1);
    add(element, part_of(tank, draining));
  }
  MassSums full = draining.fixed;
  for (const Draining::Part& part : draining.parts) {
    full.add(1.0, part.full);
    draining.is_point = draining.is_point && part.full.J_L.isZero(0.0);
  }
  put(full, tree.links[index]);
  if (draining.parts.empty()) return;
  tree.links[index].drains = true;
  tree.draining.push_back(std::move(draining));
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
    const std::size_t index = tree.links.size();
    LinkConstants& constants = tree.links.emplace_back();
    constants.parent = link.parent;
    prepare_joint(link.joint, constants);
    if (link.parent >= 0) ++tree.links[static_cast<std::size_t>(link.parent)].children;
    prepare_mass(link, index, rotor_inertia_on(static_cast<int>(index), assembly.rotors), tree);
  }
  for (const Rotor& rotor : assembly.rotors) {
    tree.rotors.push_back({rotor.link, rotor.axis_L, rotor.spin_inertia});
  }
  return tree;
}

const Draining* Tree::draining_of(std::size_t link) const {
  const auto found = std::ranges::find(draining, link, &Draining::link);
  return found == draining.end() ? nullptr : &*found;
}

void set_shares(Tree& tree, std::span<const double> shares) {
  for (const Draining& draining : tree.draining) {
    MassSums sums = draining.fixed;
    for (const Draining::Part& part : draining.parts) {
      sums.add(shares[part.tank], part.full);
    }
    put(sums, tree.links[draining.link]);
  }
}

}  // namespace twincraft::bsm
