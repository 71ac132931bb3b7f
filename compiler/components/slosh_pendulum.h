// A spherical slosh pendulum: a bob at a fixed distance from a pivot that is fixed in the mount.
// With p1 along `rest`, p2 along `reference` and p3 = p1 x p2 the bob is at
//     l = L [cos phi cos theta p1 + sin phi cos theta p2 - sin theta p3]
// turned by phi about p3, then by theta about the turned p2. The drag D on the bob is an internal
// force pair: -D L^2 cos^2 theta phiDot and -D L^2 thetaDot. A bob with an inertia of its own turns
// with both hinges and has no third rotation. At theta = 90 deg phi means nothing.
// Tested by tests/compiler/slosh_test.cpp.
#pragma once

#include <array>
#include <optional>

#include "compiler/components/slosh_particle.h"

namespace twincraft {

struct PendulumSpec : Written {
  std::string name;
  SloshType type = SloshType::kPendulum;
  std::optional<std::string> mount;         // absent: the tank's, else hub
  std::optional<std::string> tank;          // depletes with it
  double mass = 0.0;                        // [kg]
  double length = 0.0;                      // L [m]
  Vector3d rest = -Vector3d::UnitZ();       // unit, mount axes: pivot to bob at zero angles
  Vector3d reference = Vector3d::UnitX();   // unit, mount axes, perpendicular to rest
  std::optional<Vector3d> position;         // [m] pivot, mount axes; absent: the tank's centre
  std::vector<double> angles = {0.0, 0.0};  // [rad] phi, theta, initial
  std::vector<double> rates = {0.0, 0.0};   // [rad/s]
  double damping = 0.0;                     // D [N s/m]
  double inertia = 0.0;                     // [kg m^2] of the bob about its centre, isotropic
};

const Table<PendulumSpec>& pendulum_table();

/// 2 pi sqrt(L/a) [s] under a steady acceleration a [m/s^2] of the pivot; nothing without one.
std::optional<double> period_of(const PendulumSpec& pendulum, double acceleration);

/// Perpendicular axes, and a start away from where phi means nothing.
void check_pendulum(const PendulumSpec& pendulum, const std::string& who, Diagnostics& diagnostics);

/// Two hinge coordinates `NAME.phi` and `NAME.theta`. @param tank  as for a particle
void lower(const PendulumSpec& pendulum, const TankSpec* tank, ModelBuilder& builder);

}  // namespace twincraft
