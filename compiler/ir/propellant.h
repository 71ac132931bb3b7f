// How a tank runs down. One number per tank, its share at time t, says everything: the bulk and
// every slosh mass that belongs to the tank keep their proportions, so mass and inertia of each are
// those of t = 0 times the share. The share is an exact function of time and the only ledger there
// is; both engines read it. Tested by tests/compiler/ir_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "compiler/ir/schedule.h"

namespace twincraft {

/// Standard gravity, which turns a specific impulse in seconds into an exhaust speed.
inline constexpr double kStandardGravity = 9.80665;  // [m/s^2]

struct Tank {
  std::string name;
  double content = 0.0;  // [kg] at t = 0, slosh included
  Schedule mass_flow;    // [kg/s] out of the tank

  /// The integral of the flow, exact for a schedule; nothing flows before t = 0 s.
  double content_at(double time) const;  // [kg]
  double share(double time) const { return content_at(time) / content; }
};

}  // namespace twincraft
