// See sample_models.h.
#include "tests/support/sample_models.h"

#include <cmath>
#include <random>

namespace twincraft::test {
namespace {

Matrix3d diagonal(double a, double b, double c) { return Vector3d(a, b, c).asDiagonal(); }

// Axes (outboard, hinge, outboard x hinge) of a panel, as a map to the parent's components.
Matrix3d panel_axes(const Vector3d& outboard, const Vector3d& hinge) {
  Matrix3d dcm_PL;
  dcm_PL << outboard, hinge, outboard.cross(hinge);
  return dcm_PL;
}

MassElement bar(const std::string& name, double mass, double length) {
  const double across = mass * length * length / 12.0;
  return {name, mass, Vector3d(length / 2.0, 0.0, 0.0), diagonal(0.05 * across, across, across)};
}

Joint hinge(const Vector3d& r_HP_P, const Matrix3d& dcm_PL0, double stiffness, double damping) {
  Joint joint;
  joint.r_HP_P = r_HP_P;
  joint.dcm_PL0 = dcm_PL0;
  joint.axis_L = Vector3d::UnitY();
  joint.stiffness = stiffness;
  joint.damping = damping;
  return joint;
}

TreeBody tree_body(const std::string& name, int parent, const Vector3d& pos) {
  TreeBody body;
  body.name = name;
  body.parent = parent;
  body.pos = pos;
  return body;
}

}  // namespace

SampleVehicle::SampleVehicle(const std::string& name, const MassElement& hub) {
  model_.name = name;
  model_.assembly.links.push_back({"hub", -1, Joint{}, {hub}});
  TreeBody body = tree_body("hub", -1, Vector3d::Zero());
  body.link = 0;
  body.inertial = properties_of(hub);
  body.elements = {hub};
  model_.tree.bodies.push_back(body);
  model_.simulation.step = 0.01;
}

TreeBody& SampleVehicle::body_of(int link) {
  for (TreeBody& body : model_.tree.bodies) {
    if (body.link == link) return body;
  }
  return model_.tree.bodies.front();
}

int SampleVehicle::add_link(const std::string& name, int parent, const Joint& joint,
                            const MassElement& element, double position, double rate) {
  const auto link = static_cast<int>(model_.assembly.links.size());
  const auto parent_body = static_cast<int>(&body_of(parent) - model_.tree.bodies.data());
  const TreeJoint tree_joint{name,          joint.kind, joint.axis_L, joint.stiffness,
                             joint.damping, joint.rest};
  model_.assembly.links.push_back({name, parent, joint, {element}});
  TreeBody body = tree_body(name, parent_body, joint.r_HP_P);
  body.link = link;
  body.quat = Quaterniond(joint.dcm_PL0).normalized();
  body.joints = {tree_joint};
  body.inertial = properties_of(element);
  body.elements = {element};
  model_.tree.bodies.push_back(body);
  model_.initial.joint_position.push_back(position);
  model_.initial.joint_rate.push_back(rate);
  return link;
}

void SampleVehicle::add_wheel(const std::string& name, int link, const Vector3d& axis_L,
                              const Vector3d& r_WL_L, double mass, double speed, double torque) {
  const double spin = 0.08;
  const double transverse = 0.05;
  const Matrix3d tensor =
      transverse * Matrix3d::Identity() + (spin - transverse) * axis_L * axis_L.transpose();
  const double token = mass > 0.0 ? mass : model_.engines.wheel_mass;
  Link& carrier = model_.assembly.links[static_cast<std::size_t>(link)];
  const auto mount_body = static_cast<int>(&body_of(link) - model_.tree.bodies.data());
  TreeBody wheel = tree_body(name, mount_body, r_WL_L);
  wheel.joints = {TreeJoint{.name = name, .axis = axis_L}};
  wheel.inertial = {token, Vector3d::Zero(), tensor};
  if (mass > 0.0) {
    wheel.elements = {{name, mass, Vector3d::Zero(), tensor}};
    carrier.elements.push_back({name, mass, r_WL_L, tensor});
  } else {
    TreeBody& mount = body_of(link);
    mount.elements.front().I_PntE_L += tensor;
    carrier.elements.front().I_PntE_L += tensor;
    mount.inertial = mount.inertial + MassProperties{-token, r_WL_L, Matrix3d::Zero()};
  }
  model_.tree.bodies.push_back(wheel);
  model_.tree.wheels.push_back({name, static_cast<int>(model_.assembly.rotors.size())});
  model_.assembly.rotors.push_back({name, link, axis_L, spin, Schedule::constant(torque)});
  model_.initial.wheel_rate.push_back(speed);
}

Model offset_hub() {
  Matrix3d tensor;
  tensor << 400.0, 12.0, -7.0, 12.0, 380.0, 5.0, -7.0, 5.0, 360.0;
  SampleVehicle vehicle("offset_hub", {"hub", 600.0, Vector3d(0.1, -0.05, 0.2), tensor});
  vehicle.model().initial.omega_BN_B = Vector3d(0.01, -0.02, 0.015);
  return vehicle.model();
}

Model wheels_and_panels() {
  SampleVehicle vehicle("wheels_and_panels",
                        {"hub", 600.0, Vector3d::Zero(), diagonal(400.0, 380.0, 360.0)});
  for (const double side : {1.0, -1.0}) {
    const Matrix3d axes = panel_axes(side * Vector3d::UnitX(), Vector3d(0.0, -side, 0.0));
    vehicle.add_link(side > 0.0 ? "wing_p.1" : "wing_m.1", 0,
                     hinge(Vector3d(0.8 * side, 0.0, 0.0), axes, 150.0, 8.0),
                     {"wing", 50.0, Vector3d(1.2, 0.0, 0.0), diagonal(30.0, 20.0, 12.0)},
                     side * 0.2, 0.0);
  }
  for (int i = 0; i < 3; ++i) {
    vehicle.add_wheel(std::string("rw_") + "xyz"[i], 0, Vector3d::Unit(i), Vector3d::Zero(), 0.0,
                      10.0 * i, 0.01);
  }
  vehicle.model().initial.omega_BN_B = Vector3d(0.01, -0.02, 0.015);
  return vehicle.model();
}

Model two_chains(int segments) {
  SampleVehicle vehicle("two_chains",
                        {"hub", 750.0, Vector3d::Zero(), diagonal(900.0, 800.0, 600.0)});
  const double mass = 50.0 / segments;
  const double length = 6.0 / segments;
  for (const double side : {1.0, -1.0}) {
    const std::string wing = side > 0.0 ? "wing_p." : "wing_m.";
    int parent = 0;
    for (int i = 1; i <= segments; ++i) {
      const Matrix3d root = panel_axes(side * Vector3d::UnitX(), Vector3d::UnitY());
      const Joint joint =
          i == 1 ? hinge(Vector3d(side, 0.0, 0.0), root, 150.0, 1.0)
                 : hinge(length * Vector3d::UnitX(), Matrix3d::Identity(), 150.0 * segments, 1.0);
      const std::string name = wing + std::to_string(i);
      parent = vehicle.add_link(name, parent, joint, bar(name, mass, length), i == 1 ? 0.2 : 0.0);
    }
  }
  vehicle.model().initial.omega_BN_B = Vector3d(0.01, -0.02, 0.015);
  return vehicle.model();
}

Model menagerie() {
  SampleVehicle vehicle("menagerie",
                        {"hub", 600.0, Vector3d(0.1, -0.05, 0.2), diagonal(400.0, 380.0, 360.0)});
  const Matrix3d turned =
      Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
  Joint slide{.kind = JointKind::kSlide,
              .r_HP_P = Vector3d(0.0, 0.1, -0.8),
              .axis_L = Vector3d(1.0, 2.0, 2.0) / 3.0,
              .stiffness = 11.0,
              .damping = 0.1,
              .rest = 0.05,
              .effort = Schedule::constant(0.3)};
  vehicle.add_link("slosh", 0, slide, {"slosh", 25.0, Vector3d::Zero(), Matrix3d::Zero()}, 0.02);
  vehicle.add_wheel("rw_hub", 0, Vector3d(2.0, -1.0, 2.0) / 3.0, Vector3d(0.3, 0.0, 0.1), 0.0, 80.0,
                    -0.02);
  const int arm = vehicle.add_link("arm", 0, hinge(Vector3d(0.8, 0.0, 0.1), turned, 0.0, 0.4),
                                   bar("arm", 12.0, 1.1), 0.3, 0.05);
  vehicle.add_link("hand", arm, hinge(Vector3d(1.1, 0.0, 0.0), turned, 20.0, 0.4),
                   bar("hand", 3.0, 0.5), -0.2, 0.1);
  vehicle.add_link("fin", arm, hinge(Vector3d(0.5, 0.1, 0.0), turned.transpose(), 40.0, 0.0),
                   {"fin", 2.0, Vector3d(0.1, 0.2, 0.3), diagonal(0.2, 0.1, 0.3)}, 0.1, -0.1);
  vehicle.add_wheel("rw_arm", arm, Vector3d::UnitZ(), Vector3d(0.4, 0.0, 0.2), 6.0, -50.0, 0.03);
  Model& model = vehicle.model();
  model.assembly.links[2].joint.effort = Schedule{{{0.0, 0.5}, {2.0, -0.5}}};
  const auto held = [](double x, double y, double z) {
    return std::array{Schedule::constant(x), Schedule::constant(y), Schedule::constant(z)};
  };
  model.loads = {{"push", 0, held(1.0, -2.0, 0.5), held(0.2, -0.3, 0.4), Vector3d(0.0, 0.0, -1.5)},
                 {"jet", 3, held(0.1, 0.0, 0.2), held(0.0, 0.0, 0.0), Vector3d(0.5, 0.0, 0.0)},
                 {"tug", 0, held(0.0, 3.0, 0.0), held(0.0, 0.0, 0.0), std::nullopt}};
  model.initial.omega_BN_B = Vector3d(0.02, -0.03, 0.01);
  return model;
}

Eigen::VectorXd sample_state(const Model& model, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto fill = [&](auto block, double scale) {
    for (Eigen::Index i = 0; i < block.size(); ++i) block[i] = scale * unit(generator);
  };
  const auto joints = static_cast<Eigen::Index>(model.assembly.links.size()) - 1;
  const auto wheels = static_cast<Eigen::Index>(model.assembly.rotors.size());
  Eigen::VectorXd state = Eigen::VectorXd::Zero(13 + 2 * joints + wheels);
  fill(state.segment<4>(6), 1.0);
  state.segment<4>(6).normalize();
  fill(state.segment<3>(10), 0.2);
  fill(state.segment(13, joints), 0.4);
  fill(state.segment(13 + joints, joints), 0.2);
  fill(state.tail(wheels), 100.0);
  return state;
}

}  // namespace twincraft::test
