// A rigid body that is turned about one principal axis by a constant torque: rate and angle are
// polynomials of time,
//   omega(t) = omega(0) + L/I t,   theta(t) = omega(0) t + L/(2 I) t^2.
// Tested by tests/runtime/reference_test.cpp.
#pragma once

#include "runtime/reference/reference.h"

namespace twincraft {

struct SpinUp {
  Vector3d axis_B = Vector3d::UnitZ();  // principal, unit
  // After thousands of turns the rounding of a double would show in the angle.
  long double rate = 0.0L;          // omega(0) about the axis [rad/s]
  long double acceleration = 0.0L;  // L/I [rad/s^2]

  Vector3d omega_BN_B(double time) const {
    return static_cast<double>(rate + acceleration * static_cast<long double>(time)) * axis_B;
  }
  /// The turn since t = 0, B(t) to B(0) components.
  Quaterniond turn(double time) const;
};

/// `attitude_deg`, the principal angle to the true attitude, and `rate_rad_s`.
std::vector<Deviation> spin_up_deviations(const Model& model, std::span<const Observation> samples);

}  // namespace twincraft
