// See wheel.h. Tested by tests/compiler/wheel_test.cpp.
#include "compiler/components/wheel.h"

#include <fmt/format.h>

#include "compiler/components/physical.h"

namespace twincraft {
namespace {

Matrix3d tensor(const WheelSpec& wheel) {
  const double Js = wheel.spin_inertia;
  const double Jt = wheel.transverse_inertia;
  return Jt * Matrix3d::Identity() + (Js - Jt) * wheel.axis * wheel.axis.transpose();
}

}  // namespace

const Table<WheelSpec>& wheel_table() {
  static const Table<WheelSpec> table{
      "wheel",
      "A balanced reaction wheel. Position and axis are in the axes of its mount.",
      {
          required("name", &WheelSpec::name, name(), "Unique in the file."),
          optional("mount", &WheelSpec::mount, reference_to("body"), "What carries the wheel."),
          optional("position", &WheelSpec::position, vector3("m"), "Of its centre."),
          required("axis", &WheelSpec::axis, direction(), "The spin axis."),
          required("spin_inertia", &WheelSpec::spin_inertia, quantity("kg m2", Range::kPositive),
                   "About the spin axis."),
          required("transverse_inertia", &WheelSpec::transverse_inertia,
                   quantity("kg m2", Range::kPositive),
                   "About every axis across the spin axis, through the wheel's centre."),
          optional(
              "mass", &WheelSpec::mass, quantity("kg", Range::kNotNegative),
              "Mass of the wheel. With 0 (default) the mount's mass already includes the wheel "
              "and `position` plays no part. A positive mass acts at `position` in both "
              "engines, and gravity pulls on it there."),
          optional("speed", &WheelSpec::speed, quantity("rad/s", Range::kAny, kUsualWheelSpeed),
                   "Initial spin relative to the mount."),
          optional("torque", &WheelSpec::torque, schedule("N m"),
                   "Of the motor on the wheel about its axis; the mount feels the opposite."),
      }};
  return table;
}

void check(const WheelSpec& wheel, const Context& context, Diagnostics& diagnostics) {
  const std::string who = fmt::format("wheel `{}`", wheel.name);
  check_mount(wheel.mount, wheel.span_of("mount"), who, context.names, diagnostics);
  if (wheel.mass > 0.0) check_mass(wheel.mass, wheel.span_of("mass"), who, diagnostics);
  // Principal axes directly: forming the tensor about a slanted axis would add rounding.
  const Vector3d moments(wheel.transverse_inertia, wheel.transverse_inertia, wheel.spin_inertia);
  check_inertia(moments.asDiagonal(), wheel.span_of("spin_inertia"), who, diagnostics);
}

void lower(const WheelSpec& wheel, const Vehicle&, ModelBuilder& builder) {
  Rotor rotor;
  rotor.name = wheel.name;
  rotor.axis_L = wheel.axis;
  rotor.spin_inertia = wheel.spin_inertia;
  rotor.torque = wheel.torque;
  const MassElement element{wheel.name, wheel.mass, wheel.position, tensor(wheel)};
  const int index = builder.add_wheel(builder.find_mount(wheel.mount), rotor, element);
  builder.add_coordinate(Coordinate::Kind::kWheel, wheel.name, index, 0.0, wheel.speed);
}

Coordinates coordinates_of(const WheelSpec& wheel) { return {1, wheel.span_of("name")}; }

double mass_of(const WheelSpec& wheel) { return wheel.mass; }

}  // namespace twincraft
