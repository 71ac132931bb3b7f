// Both halves of the model, entry by entry; see the header for what happens to wheels.
// Tested by tests/compiler/model_builder_test.cpp.
#include "compiler/model_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace twincraft {
namespace {

template <class T>
auto& at(std::vector<T>& items, int index) {
  return items.at(static_cast<std::size_t>(index));
}

template <class T>
int size_of(const std::vector<T>& items) {
  return static_cast<int>(items.size());
}

void put(std::vector<double>& values, int index, double value) {
  const auto position = static_cast<std::size_t>(index);
  values.resize(std::max(values.size(), position + 1));
  values[position] = value;
}

int tree_depth(const BodyTree& tree) {
  std::vector<int> depth;
  for (const TreeBody& body : tree.bodies) {
    depth.push_back(body.parent < 0 ? 0 : at(depth, body.parent) + 1);
  }
  return *std::max_element(depth.begin(), depth.end());
}

}  // namespace

ModelBuilder::ModelBuilder(EngineControls controls) { model_.engines = controls; }

void ModelBuilder::add_hub() {
  Link link;
  link.name = "hub";
  model_.assembly.links.push_back(std::move(link));
  TreeBody body;
  body.name = "hub";
  body.link = 0;
  model_.tree.bodies.push_back(std::move(body));
  mounts_["hub"] = Mount{};
}

Mount ModelBuilder::add_link(const Mount& parent, const std::string& name, const Joint& joint) {
  const Mount mount{size_of(model_.assembly.links), size_of(model_.tree.bodies)};
  model_.assembly.links.push_back({name, parent.link, joint, {}});

  TreeBody body;
  body.name = name;
  body.parent = parent.body;
  body.link = mount.link;
  body.pos = joint.r_HP_P;
  body.quat = Quaterniond(joint.dcm_PL0);
  body.joints.push_back(
      {name, joint.kind, joint.axis_L, joint.stiffness, joint.damping, joint.rest});
  model_.tree.bodies.push_back(std::move(body));

  put(model_.initial.joint_position, mount.link - 1, 0.0);
  put(model_.initial.joint_rate, mount.link - 1, 0.0);
  mounts_[name] = mount;
  return mount;
}

Mount ModelBuilder::find_mount(const std::string& name) const { return mounts_.at(name); }

void ModelBuilder::add_mass(const Mount& mount, const MassElement& element) {
  auto& on_link = at(model_.assembly.links, mount.link).elements;
  if (on_link.empty() && !(element.mass > 0.0)) {
    throw std::logic_error("the first mass element of link `" +
                           at(model_.assembly.links, mount.link).name + "` has no mass");
  }
  on_link.push_back(element);
  at(model_.tree.bodies, mount.body).elements.push_back(element);
}

int ModelBuilder::add_wheel(const Mount& mount, const Rotor& rotor, const MassElement& element) {
  const int index = size_of(model_.assembly.rotors);
  model_.assembly.rotors.push_back(rotor);
  model_.assembly.rotors.back().link = mount.link;
  put(model_.initial.rotor_speed, index, 0.0);

  const bool massless = element.mass == 0.0;
  MassElement wheel = element;  // as it sits in its own body: at the origin
  wheel.r_EL_L.setZero();
  if (massless) wheel.mass = model_.engines.wheel_mass;

  TreeBody body;
  body.name = rotor.name;
  body.parent = mount.body;
  body.pos = element.r_EL_L;
  TreeJoint hinge;
  hinge.name = rotor.name;
  hinge.axis = rotor.axis_L;
  body.joints.push_back(hinge);
  body.inertial = properties_of(wheel);
  if (massless) {
    massless_.push_back({mount, element});
    wheel.I_PntE_L.setZero();  // gravity finds the tensor on the mount
    if (!model_.engines.compensate) body.elements.push_back(wheel);
  } else {
    at(model_.assembly.links, mount.link).elements.push_back(element);
    body.elements.push_back(wheel);
  }
  model_.tree.bodies.push_back(std::move(body));
  model_.tree.wheels.push_back({rotor.name, index});
  return index;
  return index;
}

void ModelBuilder::add_coordinate(Coordinate::Kind kind, const std::string& name, int index,
                                  double position, double rate) {
  model_.coordinates.push_back({name, kind, index});
  if (kind == Coordinate::Kind::kWheel) {
    put(model_.initial.rotor_speed, index, rate);
  } else {
    put(model_.initial.joint_position, index - 1, position);
    put(model_.initial.joint_rate, index - 1, rate);
  }
}

void ModelBuilder::add_load(Load load) { model_.loads.push_back(std::move(load)); }

Model ModelBuilder::build() && {
  form_inertials();
  carry_massless_wheels();
  refuse_deep_chains();
  return std::move(model_);
}

void ModelBuilder::form_inertials() {
  for (TreeBody& body : model_.tree.bodies) {
    if (body.link < 0) continue;  // a wheel, which brought its own
    MassProperties sum;
    for (const MassElement& element : body.elements) sum = sum + properties_of(element);
    body.inertial = sum;
  }
  if (!model_.engines.compensate) return;
  for (const MasslessWheel& wheel : massless_) {
    MassElement token;
    token.mass = -model_.engines.wheel_mass;
    token.r_EL_L = wheel.element.r_EL_L;
    MassProperties& inertial = at(model_.tree.bodies, wheel.mount.body).inertial;
    inertial = inertial + properties_of(token);
  }
}

void ModelBuilder::carry_massless_wheels() {
  for (const MasslessWheel& wheel : massless_) {
    const Matrix3d& tensor = wheel.element.I_PntE_L;
    at(model_.assembly.links, wheel.mount.link).elements.at(0).I_PntE_L += tensor;
    at(model_.tree.bodies, wheel.mount.body).elements.at(0).I_PntE_L += tensor;
  }
}

void ModelBuilder::refuse_deep_chains() {
  const int depth = tree_depth(model_.tree);
  if (depth <= kMaximumTreeDepth) return;
  model_.mujoco_refusal = fmt::format(
      "a chain of {} bodies below the hub is deeper than the {} that MuJoCo's XML reader allows",
      depth, kMaximumTreeDepth);
}

}  // namespace twincraft
