// States that somebody else computed, attached to a model as truth. Tested by
// tests/compiler/stored_test.cpp and tests/runtime/stored_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/ir/mass.h"

namespace twincraft {

/// What is known of the vehicle at one time; what is not known is absent.
struct StoredState {
  double time = 0.0;                   // [s]
  std::optional<Vector3d> position;    // [m] N components
  std::optional<Vector3d> velocity;    // [m/s]
  std::optional<Quaterniond> q_BN;     // B to N components
  std::optional<Vector3d> omega_BN_B;  // [rad/s]
};

struct StoredTruth {
  std::string source;
  bool of_hub = false;  // position and velocity are those of B; else of the system centre of mass
  std::vector<StoredState> states;  // by time; empty: the model is not held against any
  // Tolerances of the verdict; absent: reported, not judged.
  std::optional<double> position;  // [m]
  std::optional<double> velocity;  // [m/s]
  std::optional<double> attitude;  // [rad]
  std::optional<double> rate;      // [rad/s]
};

}  // namespace twincraft
