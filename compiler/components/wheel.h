// A balanced reaction wheel: a rotor whose centre of mass lies on its spin axis and whose tensor is
// the same at every spin angle, Jt 1 + (Js - Jt) a a^T. Only its spin relative to the mount is a
// state. Without mass it is the usual idealisation: its mass is counted in the mount's, its whole
// tensor adds to the mount's, and where it sits does not matter. With a mass it is a mass of its
// own on the mount, at its position. Tested by tests/compiler/wheel_test.cpp.
#pragma once

#include "compiler/components/section.h"

namespace twincraft {

struct WheelSpec : Written {
  std::string name;
  std::string mount = "hub";
  Vector3d position = Vector3d::Zero();  // [m] centre, mount axes
  Vector3d axis = Vector3d::UnitZ();     // unit, mount axes
  double spin_inertia = 0.0;             // Js [kg m^2]
  double transverse_inertia = 0.0;       // Jt [kg m^2]
  double mass = 0.0;                     // [kg]
  double speed = 0.0;                    // [rad/s] initial, relative to the mount
  Schedule torque;                       // [N m] of the motor, on the wheel
};

const Table<WheelSpec>& wheel_table();

/// The mount must carry it and the tensor must be some body's: Js <= 2 Jt.
void check(const WheelSpec& wheel, const Context& context, Diagnostics& diagnostics);

void lower(const WheelSpec& wheel, const Vehicle& vehicle, ModelBuilder& builder);

Coordinates coordinates_of(const WheelSpec& wheel);
double mass_of(const WheelSpec& wheel);

}  // namespace twincraft
