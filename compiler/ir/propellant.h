// How a tank runs down. One number per tank, its share at time t, says everything: the bulk and
// every slosh mass that belongs to the tank keep their proportions, so mass and inertia of each are
// those of t = 0 times the share. The share is an exact function of time and the only ledger there
// is; both engines read it. Tested by tests/compiler/ir_test.cpp.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "compiler/ir/schedule.h"

namespace twincraft {

/// Standard gravity, which turns a specific impulse in seconds into an exhaust speed.
inline constexpr double kStandardGravity = 9.80665;  // [m/s^2]

/// What propellant takes along besides the thrust. kNone: an element of a tank shrinks where it is,
/// with the velocity it has there. kJet: it flows to the nozzle and leaves with the nozzle's
/// velocity (runtime/forces/stream.h).
enum class LeavingMomentum { kNone, kJet };

/// A tank that has run down at steady flows, one after another.
struct Drain {
  double full = 0.0;   // [kg] at t = 0
  double spent = 0.0;  // [kg] until `since`
  double since = 0.0;  // [s] never before t = 0: nothing flows earlier
  double flow = 0.0;   // [kg/s] from then on

  double content(double time) const { return full - spent_at(time); }  // [kg]
  double share(double time) const { return content(time) / full; }     // of what it held
  /// When nothing is left at this flow [s]; infinite: it does not flow.
  double empty_at() const {
    return flow > 0.0 ? since + (full - spent) / flow : std::numeric_limits<double>::infinity();
  }
  double share_rate() const { return -flow / full; }  // [1/s]
  /// Another flow from `time` [s] on. @pre not before `since`, unless both are before t = 0
  void change(double time, double to) {
    spent = spent_at(time);
    since = std::max(time, 0.0);
    flow = to;
  }

 private:
  double spent_at(double time) const { return spent + flow * std::max(time - since, 0.0); }
};

struct Tank {
  std::string name;
  double content = 0.0;  // [kg] at t = 0, slosh included
  Schedule mass_flow;    // [kg/s] out of the tank
  LeavingMomentum momentum = LeavingMomentum::kNone;

  /// The integral of the flow, exact for a schedule; nothing flows before t = 0 s.
  double content_at(double time) const;  // [kg]
  double share(double time) const { return content_at(time) / content; }
};

/// Where propellant of a tank leaves the vehicle.
struct Nozzle {
  std::string name;                                  // the thruster
  int tank = 0;                                      // Model::tanks entry it draws from
  int link = 0;                                      // what it is fixed on
  Eigen::Vector3d r_PL_L = Eigen::Vector3d::Zero();  // [m] from the link's origin, link axes
  Schedule mass_flow;                                // [kg/s]
};

}  // namespace twincraft
