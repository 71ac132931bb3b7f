// Both halves of the model, entry by entry; see the header for what happens to wheels and fixed
// bodies.
// Tested by tests/compiler/model_builder_test.cpp.
#include "compiler/components/model_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

TreeJoint tree_joint(const std::string& name, const Joint& joint) {
  return {name, joint.kind, joint.axis_L, joint.stiffness, joint.damping, joint.rest};
}

MassElement on_link(const Mount& mount, const MassElement& element) {
  return seated(element, {.link = mount.link, .dcm_LS = mount.dcm_LM, .r_SL_L = mount.r_ML_L});
}

std::array<Schedule, 3> on_link(const Mount& mount, const std::array<Schedule, 3>& vector) {
  std::array<Schedule, 3> turned;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double share = mount.dcm_LM(static_cast<int>(i), static_cast<int>(j));
      if (share != 0.0) turned[i] = turned[i] + vector[j].scaled(share);
    }
  }
  return turned;
}

/// @pre there is one of that name
MassElement& named(std::vector<MassElement>& elements, const std::string& name) {
  return *std::ranges::find(elements, name, &MassElement::name);
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
  const Mount mount{.link = size_of(model_.assembly.links), .body = size_of(model_.tree.bodies)};
  Joint joint_on_link = joint;
  joint_on_link.r_HP_P = parent.point_on_link(joint.r_HP_P);
  joint_on_link.dcm_PL0 = parent.dcm_LM * joint.dcm_PL0;
  model_.assembly.links.push_back({name, parent.link, std::move(joint_on_link), {}});

  TreeBody body;
  body.name = name;
  body.parent = parent.body;
  body.link = mount.link;
  body.pos = joint.r_HP_P;
  body.quat = Quaterniond(joint.dcm_PL0);
  body.joints.push_back(tree_joint(name, joint));
  model_.tree.bodies.push_back(std::move(body));

  put(model_.initial.joint_position, mount.link - 1, 0.0);
  put(model_.initial.joint_rate, mount.link - 1, 0.0);
  mounts_[name] = mount;
  return mount;
}

ModelBuilder::Pendulum ModelBuilder::add_pendulum(const Mount& parent, const std::string& name,
                                                  const Joint& phi, const Joint& theta) {
  const Mount swing = add_link(parent, name + ".phi", phi);
  const Mount bob{.link = swing.link + 1, .body = swing.body};
  model_.assembly.links.push_back({name + ".theta", swing.link, theta, {}});
  at(model_.assembly.links, swing.link).joint.damped_by_cosine_of = bob.link;
  TreeBody& body = at(model_.tree.bodies, bob.body);
  body.name = name;
  body.link = bob.link;
  body.joints.push_back(tree_joint(name + ".theta", theta));
  put(model_.initial.joint_position, bob.link - 1, 0.0);
  put(model_.initial.joint_rate, bob.link - 1, 0.0);
  return {swing.link, bob};
}

Mount ModelBuilder::add_fixed_body(const Mount& parent, const std::string& name,
                                   const Vector3d& r_MP_P, const Matrix3d& dcm_PM) {
  TreeBody body;
  body.name = name;
  body.parent = parent.body;
  body.link = parent.link;
  body.pos = r_MP_P;
  body.quat = Quaterniond(dcm_PM);
  const Mount mount{.link = parent.link,
                    .body = size_of(model_.tree.bodies),
                    .dcm_LM = parent.dcm_LM * dcm_PM,
                    .r_ML_L = parent.point_on_link(r_MP_P)};
  model_.tree.bodies.push_back(std::move(body));
  mounts_[name] = mount;
  return mount;
}

Mount ModelBuilder::find_mount(const std::string& name) const { return mounts_.at(name); }

void ModelBuilder::draw(const Mount& mount, const Look& look) {
  at(model_.tree.bodies, mount.body).look = look;
}

void ModelBuilder::add_mass(const Mount& mount, const MassElement& element) {
  TreeBody& body = at(model_.tree.bodies, mount.body);
  if (body.elements.empty() && !(element.mass > 0.0)) {
    throw std::logic_error("the first mass element of `" + body.name + "` has no mass");
  }
  at(model_.assembly.links, mount.link).elements.push_back(on_link(mount, element));
  body.elements.push_back(element);
  body.tank = element.tank;
}

void ModelBuilder::add_token_inertia(const Mount& mount, double inertia) {
  at(model_.tree.bodies, mount.body).token_inertia += inertia;
}

int ModelBuilder::add_tank(Tank tank) {
  model_.tanks.push_back(std::move(tank));
  return size_of(model_.tanks) - 1;
}

int ModelBuilder::find_tank(const std::string& name) const {
  const auto tank = std::find_if(model_.tanks.begin(), model_.tanks.end(),
                                 [&](const Tank& each) { return each.name == name; });
  return static_cast<int>(tank - model_.tanks.begin());
}

int ModelBuilder::add_wheel(const Mount& mount, const Rotor& rotor, const MassElement& element) {
  const int index = size_of(model_.assembly.rotors);
  model_.assembly.rotors.push_back(rotor);
  model_.assembly.rotors.back().link = mount.link;
  model_.assembly.rotors.back().axis_L = mount.dcm_LM * rotor.axis_L;
  put(model_.initial.wheel_rate, index, 0.0);

  CarriedWheel wheel{mount, element, size_of(model_.tree.bodies)};
  MassElement token;
  token.name = element.name;
  token.mass = model_.engines.wheel_mass;
  if (!wheel.massless()) token.mass = std::min(token.mass, element.mass);

  TreeBody body;
  body.name = rotor.name;
  body.parent = mount.body;
  body.pos = element.r_EL_L;
  TreeJoint hinge;
  hinge.name = rotor.name;
  hinge.axis = rotor.axis_L;
  body.joints.push_back(hinge);
  body.inertial = {token.mass, Vector3d::Zero(), element.I_PntE_L};
  if (is_on_top(wheel)) body.elements.push_back(token);
  model_.tree.bodies.push_back(std::move(body));
  model_.tree.wheels.push_back({rotor.name, index, wheel.body});

  if (!wheel.massless()) {
    at(model_.assembly.links, mount.link).elements.push_back(on_link(mount, element));
    MassElement on_mount = element;
    on_mount.I_PntE_L.setZero();  // until the inertials are formed: the wheel's body has the tensor
    at(model_.tree.bodies, mount.body).elements.push_back(on_mount);
  }
  wheels_.push_back(std::move(wheel));
  return index;
}

void ModelBuilder::add_coordinate(Coordinate::Kind kind, const std::string& name, int index,
                                  double position, double rate) {
  model_.coordinates.push_back({name, kind, index});
  if (model_.coordinates.back().is_wheel()) {
    put(model_.initial.wheel_rate, index, rate);
  } else {
    put(model_.initial.joint_position, index - 1, position);
    put(model_.initial.joint_rate, index - 1, rate);
  }
}

void ModelBuilder::add_load(const Mount& mount, Load load) {
  load.link = mount.link;
  load.force_L = on_link(mount, load.force_M);
  load.torque_L = on_link(mount, load.torque_M);
  load.dcm_LM = mount.dcm_LM;
  if (load.r_FL_L) load.r_FL_L = mount.point_on_link(*load.r_FL_L);
  model_.loads.push_back(std::move(load));
}

int ModelBuilder::add_nozzle(const Mount& mount, Nozzle nozzle) {
  if (at(model_.tanks, nozzle.tank).momentum == LeavingMomentum::kNone) return -1;
  nozzle.link = mount.link;
  nozzle.r_PL_L = mount.point_on_link(nozzle.r_PL_L);
  model_.nozzles.push_back(std::move(nozzle));
  return size_of(model_.nozzles) - 1;
}

Model ModelBuilder::build() && {
  form_inertials();
  take_tokens_out();
  carry_wheel_tensors();
  form_streams();
  refuse_deep_chains();
  refuse_many_coordinates();
  return std::move(model_);
}

void ModelBuilder::form_streams() {
  for (std::size_t n = 0; n < model_.nozzles.size(); ++n) {
    const Nozzle& nozzle = model_.nozzles[n];
    const double content = at(model_.tanks, nozzle.tank).content;
    for (std::size_t i = 0; i < model_.assembly.links.size(); ++i)
      for (const MassElement& e : model_.assembly.links[i].elements)
        if (e.tank == nozzle.tank)
          model_.forces.streams.push_back({static_cast<int>(n), e.mass / content, nozzle.link,
                                           static_cast<int>(i), nozzle.r_PL_L, e.r_EL_L,
                                           e.I_PntE_L / e.mass});
  }
}

void ModelBuilder::form_inertials() {
  for (TreeBody& body : model_.tree.bodies) {
    if (body.link < 0) continue;  // a wheel's, which brought its own
    MassProperties sum;
    sum.I_PntC_L = body.token_inertia * Matrix3d::Identity();
    for (const MassElement& element : body.elements) sum = sum + properties_of(element);
    body.inertial = sum;
  }
}

bool ModelBuilder::is_on_top(const CarriedWheel& wheel) const {
  return wheel.massless() && !model_.engines.compensate;
}

// At the mount's centre of mass, so that nothing but the mass of its inertial changes.
void ModelBuilder::take_tokens_out() {
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const CarriedWheel& wheel = wheels_[i];
    if (is_on_top(wheel)) continue;
    MassProperties& mount = at(model_.tree.bodies, wheel.mount.body).inertial;
    TreeBody& token = at(model_.tree.bodies, wheel.body);
    mount.mass -= token.inertial.mass;
    token.pos = mount.r_CL_L;
    model_.tree.wheels[i].center = wheel.element.r_EL_L;
  }
}

void ModelBuilder::carry_wheel_tensors() {
  for (const CarriedWheel& wheel : wheels_) {
    std::vector<MassElement>& on_body = at(model_.tree.bodies, wheel.mount.body).elements;
    MassElement& element = wheel.massless() ? on_body.at(0) : named(on_body, wheel.element.name);
    element.I_PntE_L += wheel.element.I_PntE_L;
    if (!wheel.massless()) continue;  // the assembly has its element
    Link& link = at(model_.assembly.links, wheel.mount.link);
    named(link.elements, element.name).I_PntE_L += on_link(wheel.mount, wheel.element).I_PntE_L;
  }
}

void ModelBuilder::refuse_deep_chains() {
  const int depth = std::ranges::max(depths_of(model_.tree));
  if (depth <= kMaximumTreeDepth) return;
  model_.mujoco_refusal = fmt::format(
      "a chain of {} bodies below the hub is deeper than the {} that MuJoCo's XML reader allows",
      depth, kMaximumTreeDepth);
}

void ModelBuilder::refuse_many_coordinates() {
  const int coordinates = model_.degrees_of_freedom() - 6;
  if (coordinates <= kMaximumTreeCoordinates || !model_.mujoco_refusal.empty()) return;
  model_.mujoco_refusal =
      fmt::format("{} joints and wheels are more than the {} that MuJoCo's XML reader allows",
                  coordinates, kMaximumTreeCoordinates);
}

}  // namespace twincraft
