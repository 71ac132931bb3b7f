// What an engine should have kept: energy, momentum and angular momentum, each against the books of
// what came from outside. Relative to the magnitudes that were there, so that a total near zero
// (opposed wheels, a vehicle at rest) does not make rounding look large.
// Tested by tests/runtime/conservation_test.cpp.
#pragma once

#include <optional>
#include <string>

#include "runtime/study/propagate.h"

namespace twincraft {

/// Largest imbalances over the samples of one trajectory.
struct Conservation {
  double energy = 0.0;    // |E - E0 - work| / max|E|; max kinetic when E is near zero
  double momentum = 0.0;  // |p - p0 - impulse| / max momentum_scale
  // |H - H0 - angular impulse| / max H_scale, about C; of a vehicle that never turns impulse or
  // momentum times 1 m stands for the scale
  double angular_momentum = 0.0;
};

/// The same balances as they go; valid as long as the trajectory is.
/// @pre one entry of books per sample, at least one
class ConservationCurve {
 public:
  explicit ConservationCurve(const Trajectory& trajectory);
  Conservation at(std::size_t sample) const;

 private:
  const Trajectory* trajectory_;
  double energy_scale_, momentum_scale_, H_scale_;
};

/// A trajectory without samples has nothing to lose: all zero. A NaN stays a NaN.
/// @pre one entry of books per sample
Conservation conservation_of(const Trajectory& trajectory);

/// One balance of a member: the larger imbalance of its engines, and whose it is.
struct Balance {
  std::string key;  // `energy_relative`, as in report.json
  double maximum = 0.0;
  std::string engine = {};               // "bsm", "mujoco"
  std::optional<double> tolerance = {};  // nothing: reported, not judged

  /// Nothing when there is no tolerance.
  std::optional<bool> pass() const;
};

}  // namespace twincraft
