// Small vehicles put together without a spec, for tests of the stages behind the components.
#pragma once

#include "compiler/components/model_builder.h"

namespace twincraft::test {

inline MassElement lump(const std::string& name, double mass, const Vector3d& at,
                        const Vector3d& moments) {
  return {name, mass, at, moments.asDiagonal()};
}

inline Rotor rotor(const std::string& name, const Vector3d& axis, double spin_inertia) {
  Rotor made;
  made.name = name;
  made.axis_L = axis.normalized();
  made.spin_inertia = spin_inertia;
  return made;
}

/// The tensor of a wheel about a slanted axis, as its component forms it.
inline MassElement wheel_element(const Rotor& wheel, double mass, const Vector3d& at) {
  const double transverse = 0.6 * wheel.spin_inertia;
  const Matrix3d tensor = transverse * Matrix3d::Identity() + (wheel.spin_inertia - transverse) *
                                                                  wheel.axis_L *
                                                                  wheel.axis_L.transpose();
  return {wheel.name, mass, at, tensor};
}

inline Joint hinge(const Vector3d& at, const Vector3d& axis) {
  Joint joint;
  joint.r_HP_P = at;
  joint.axis_L = axis.normalized();
  joint.dcm_PL0 = Eigen::AngleAxisd(0.3, Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  joint.stiffness = 150.0;
  joint.damping = 8.0;
  joint.rest = 0.1;
  return joint;
}

/// Hub with two wheels (one massless on it, one with mass on the boom), a boom and a slider.
inline ModelBuilder boom_and_wheels(EngineControls controls = {}) {
  ModelBuilder builder(controls);
  builder.add_hub();
  builder.add_mass({}, lump("hub", 600.0, {0.1, -0.2, 0.05}, {400.0, 380.0, 360.0}));
  const Mount boom = builder.add_link({}, "boom", hinge({0.8, 0.1, 0.0}, {0.0, -1.0, 0.2}));
  builder.add_mass(boom, lump("boom", 50.0, {1.2, 0.0, 0.0}, {3.0, 20.0, 21.0}));
  builder.add_coordinate(Coordinate::Kind::kPanel, "boom", boom.link, 0.2, -0.01);
  Joint slide = hinge({2.4, 0.0, 0.0}, {1.0, 0.0, 0.0});
  slide.kind = JointKind::kSlide;
  const Mount slider = builder.add_link(boom, "slider", slide);
  builder.add_mass(slider, lump("slider", 5.0, {0.0, 0.1, 0.0}, {0.3, 0.2, 0.4}));
  builder.add_coordinate(Coordinate::Kind::kBodyDisplacement, "slider", slider.link, 0.05, 0.0);

  const Rotor light = rotor("rw_light", {1.0, 1.0, 0.5}, 0.08);
  const int light_index = builder.add_wheel({}, light, wheel_element(light, 0.0, {0.3, 0.0, 0.1}));
  builder.add_coordinate(Coordinate::Kind::kWheel, "rw_light", light_index, 0.0, 100.0);
  const Rotor heavy = rotor("rw_heavy", {0.0, 1.0, -2.0}, 0.05);
  const int heavy_index = builder.add_wheel(boom, heavy, wheel_element(heavy, 4.0, {0.5, 0.2, 0}));
  builder.add_coordinate(Coordinate::Kind::kWheel, "rw_heavy", heavy_index, 0.0, -50.0);
  return builder;
}

/// Hub with a boom, on it a fixed bracket that carries two wheels (one massless) and a finger, and
/// beside the bracket a twig: a branch on either side of a weld.
inline ModelBuilder bracket_on_boom(EngineControls controls = {}) {
  ModelBuilder builder(controls);
  builder.add_hub();
  builder.add_mass({}, lump("hub", 600.0, {0.1, -0.2, 0.05}, {400.0, 380.0, 360.0}));
  const Mount boom = builder.add_link({}, "boom", hinge({0.8, 0.1, 0.0}, {0.0, -1.0, 0.2}));
  builder.add_mass(boom, lump("boom", 50.0, {1.2, 0.0, 0.0}, {3.0, 20.0, 21.0}));
  const Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vector3d(2.0, -1.0, 1.0).normalized()).toRotationMatrix();
  const Mount bracket = builder.add_fixed_body(boom, "bracket", {2.0, 0.1, -0.2}, turn);
  builder.add_mass(bracket, lump("bracket", 6.0, {0.1, 0.2, 0.0}, {0.3, 0.4, 0.5}));
  const Mount finger = builder.add_link(bracket, "finger", hinge({0.3, 0.0, 0.1}, {1.0, 0.0, 1.0}));
  builder.add_mass(finger, lump("finger", 2.0, {0.2, 0.0, 0.0}, {0.02, 0.05, 0.06}));
  const Mount twig = builder.add_link(boom, "twig", hinge({1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}));
  builder.add_mass(twig, lump("twig", 3.0, {0.0, 0.3, 0.0}, {0.1, 0.02, 0.1}));
  builder.add_coordinate(Coordinate::Kind::kBodyAngle, "boom", boom.link, 0.1, 0.0);
  builder.add_coordinate(Coordinate::Kind::kBodyAngle, "finger", finger.link, 0.2, 0.0);
  builder.add_coordinate(Coordinate::Kind::kBodyAngle, "twig", twig.link, 0.3, 0.0);
  for (const double mass : {0.0, 4.0}) {
    const Rotor wheel = rotor(mass > 0.0 ? "rw_heavy" : "rw_light", {1.0, 1.0, 0.5}, 0.08);
    const int index = builder.add_wheel(bracket, wheel, wheel_element(wheel, mass, {0.3, 0, 0.1}));
    builder.add_coordinate(Coordinate::Kind::kWheel, wheel.name, index, 0.0, 100.0);
  }
  return builder;
}

/// Chains of hinged links on the hub, none longer than `longest`; nothing else.
inline ModelBuilder chain(int links, int longest = 1000) {
  ModelBuilder builder{EngineControls{}};
  builder.add_hub();
  builder.add_mass({}, lump("hub", 600.0, Vector3d::Zero(), {400.0, 380.0, 360.0}));
  Mount mount;
  for (int i = 1; i <= links; ++i) {
    const std::string name = "wing." + std::to_string(i);
    if (i % longest == 1) mount = {};
    mount = builder.add_link(mount, name, hinge({0.1, 0.0, 0.0}, {0.0, 1.0, 0.0}));
    builder.add_mass(mount, lump(name, 0.5, {0.05, 0.0, 0.0}, {0.001, 0.002, 0.0025}));
    builder.add_coordinate(Coordinate::Kind::kPanel, name, mount.link, 0.0, 0.0);
  }
  return builder;
}

}  // namespace twincraft::test
