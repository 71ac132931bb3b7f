// Osculating elements of a bound orbit, and the position and velocity they stand for.
// Tested by tests/compiler/initial_test.cpp.
#pragma once

#include "compiler/ir/mass.h"
#include "compiler/schema/table.h"

namespace twincraft {

struct OrbitSpec : Written {
  double semi_major_axis = 0.0;  // [m]
  double eccentricity = 0.0;
  double inclination = 0.0;            // [rad]
  double raan = 0.0;                   // [rad] right ascension of the ascending node
  double argument_of_periapsis = 0.0;  // [rad]
  double true_anomaly = 0.0;           // [rad]
};

/// Where some point of the vehicle is and how it moves.
struct PointState {
  Vector3d r_N = Vector3d::Zero();  // [m] from the origin of N
  Vector3d v_N = Vector3d::Zero();  // [m/s]
};

const Table<OrbitSpec>& orbit_table();

/// The orbit must be bound: e < 1.
void check(const OrbitSpec& orbit, Diagnostics& diagnostics);

/// @param mu  [m^3/s^2]. @pre check passed
PointState state_of(const OrbitSpec& orbit, double mu);

}  // namespace twincraft
