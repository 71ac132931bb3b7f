// What an engine should have kept: energy, momentum and angular momentum, each against the books of
// what came from outside. Relative to the magnitudes that were there, so that a total near zero
// (opposed wheels, a vehicle at rest) does not make rounding look large.
// Tested by tests/runtime/conservation_test.cpp.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/compare/agreement.h"
#include "runtime/simulate/propagate.h"

namespace twincraft {

/// Largest imbalances over the samples of one trajectory.
struct Conservation {
  double energy = 0.0;    // |E - E0 - work| / max|E|; max kinetic when E is near zero
  double momentum = 0.0;  // |p - p0 - impulse| / max momentum_scale
  // |H - H0 - angular impulse| / max H_scale, about C; of a vehicle that never turns impulse or
  // momentum times 1 m stands for the scale
  double angular_momentum = 0.0;
};

/// A quantity that must be kept: of each kind a row, in the order of the report.
struct BalanceRow {
  std::string_view key;              // `energy_relative`, as in report.json
  std::string_view quantity, label;  // `energy`, `energy balance`
  double Conservation::*imbalance;
  std::optional<double> AgreementTolerances::*tolerance;
};
inline constexpr std::array<BalanceRow, 3> kBalances{{
    {"energy_relative", "energy", "energy balance", &Conservation::energy,
     &AgreementTolerances::energy},
    {"momentum_relative", "momentum", "momentum", &Conservation::momentum,
     &AgreementTolerances::momentum},
    {"angular_momentum_relative", "angular momentum", "angular momentum",
     &Conservation::angular_momentum, &AgreementTolerances::angular_momentum},
}};
/// Nothing when no balance has this key.
const BalanceRow* find_balance(std::string_view key);

/// The balances of a run while its samples come. What they are relative to is known at the end, so
/// imbalances and scales are kept apart.
class ConservationMeter : public SampleSink {
 public:
  void take(const Observation& sample, const Books& books) override;

  /// Of the last sample, not yet relative: [J], [kg m/s], [kg m^2/s].
  const Conservation& imbalance() const { return now_; }
  /// What imbalances are relative to, as far as the run got.
  Conservation scales() const;
  /// An imbalance of zero is zero whatever its scale.
  static double relative(double imbalance, double scale);
  /// Largest imbalances over their scales.
  Conservation result() const;

 private:
  void widen_scales(const Observation& sample, const Books& books);

  struct Start {
    double kinetic, potential;
    Vector3d momentum, H;
  };
  std::optional<Start> start_;
  Conservation now_;
  Peak energy_, momentum_, angular_momentum_;  // largest imbalances
  Peak energy_scale_, kinetic_scale_, momentum_scale_, H_scale_, impulse_scale_;
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
