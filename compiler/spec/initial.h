// Where the vehicle is at t = 0, how it is turned and how it moves. Authors name the state of the
// system centre of mass C or of the hub origin B; both engines start from B, so the difference is
// worked out once, here. Tested by tests/compiler/initial_test.cpp.
#pragma once

#include <optional>

#include "compiler/components/attitude.h"
#include "compiler/spec/environment.h"

namespace twincraft {

enum class StartPoint { kCenterOfMass, kHub };

struct InitialSpec : Written {
  std::optional<OrbitSpec> orbit;
  Vector3d position = Vector3d::Zero();  // [m] N components
  Vector3d velocity = Vector3d::Zero();  // [m/s]
  StartPoint point = StartPoint::kCenterOfMass;
  std::optional<AttitudeSpec> attitude;  // absent: B and N coincide
  Vector3d rate = Vector3d::Zero();      // omega_BN_B [rad/s]
};

const Table<InitialSpec>& initial_table();

/// What needs an attracting body must have one; the attitude must be a rotation.
void check(const InitialSpec& initial, const EnvironmentSpec& environment,
           Diagnostics& diagnostics);

/// How B is turned from N at t = 0. @pre check passed
Quaterniond attitude(const InitialSpec& initial, const EnvironmentSpec& environment);

/// Place B. @pre the model has all its links and their initial coordinates
void lower(const InitialSpec& initial, const EnvironmentSpec& environment, Model& model);

}  // namespace twincraft
