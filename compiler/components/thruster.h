// A thruster: a force fixed in the axes of its mount, and propellant that leaves the tank with
// mdot = F / (g0 Isp). What momentum the propellant takes along besides the thrust, its tank says.
// Tested by tests/compiler/propellant_test.cpp.
#pragma once

#include <optional>
#include <vector>

#include "compiler/components/tank.h"

namespace twincraft {

struct ThrusterSpec : Written {
  std::string name;
  std::string mount = "hub";
  Vector3d position = Vector3d::Zero();    // [m] mount axes
  Vector3d direction = Vector3d::UnitZ();  // unit, mount axes: of the force on the vehicle
  Schedule thrust;                         // [N]
  std::optional<double> isp;               // [s]
  std::optional<std::string> tank;         // absent: thrust without depletion
  std::optional<std::vector<Schedule::Interval>> during;  // absent: always
};

const Table<ThrusterSpec>& thruster_table();

/// The thrust inside `during` [N].
Schedule thrust_of(const ThrusterSpec& thruster);

/// Out of the named tank, of all thrusters that draw from it [kg/s]. @pre check passed
Schedule mass_flow_of(const std::vector<ThrusterSpec>& thrusters, const std::string& tank);

/// Force of all thrusters at t = 0 [N], mount axes.
Vector3d thrust_at_start(const std::vector<ThrusterSpec>& thrusters);

/// Mount and tank exist; a tank needs `isp`; it burns in the run.
void check(const ThrusterSpec& thruster, const Context& context, Diagnostics& diagnostics);

/// What burns until the end of the run [s] must be in the tank.
void check_depletion(const TankSpec& tank, const std::vector<ThrusterSpec>& thrusters,
                     double duration, Diagnostics& diagnostics);

/// The force, and where the flow leaves the vehicle. @pre the tanks were lowered
void lower(const ThrusterSpec& thruster, const Vehicle& vehicle, ModelBuilder& builder);

}  // namespace twincraft
