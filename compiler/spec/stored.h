// States that somebody else computed, with their source: the truth of `references: [stored]`. A
// state is written as `initial` is, at another time and with only what is known.
// Tested by tests/compiler/stored_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/spec/initial.h"

namespace twincraft {

struct StoredStateSpec : Written {
  double time = 0.0;                 // [s]
  std::optional<Vector3d> position;  // [m] N components
  std::optional<Vector3d> velocity;  // [m/s]
  std::optional<AttitudeSpec> attitude;
  std::optional<Vector3d> rate;  // omega_BN_B [rad/s]
};

/// Absent: reported, not judged.
struct StoredToleranceSpec : Written {
  std::optional<double> position;  // [m]
  std::optional<double> velocity;  // [m/s]
  std::optional<double> attitude;  // [rad] principal angle
  std::optional<double> rate;      // [rad/s]
};

struct StoredSpec : Written {
  std::string source;
  StartPoint point = StartPoint::kCenterOfMass;  // whose position and velocity
  std::vector<StoredStateSpec> states;
  StoredToleranceSpec tolerance;
};

const Table<StoredSpec>& stored_table();

/// Every state says something, at a time after the one before it; if it is used, inside the run.
/// @param duration  of the run [s]
void check(const StoredSpec& stored, bool is_used, const EnvironmentSpec& environment,
           double duration, Diagnostics& diagnostics);

StoredTruth lower(const StoredSpec& stored, const EnvironmentSpec& environment);

}  // namespace twincraft
