// How far apart are the two engines? The largest difference of every physical quantity over two
// trajectories of one model, when it occurred, and the tolerance that the spec gives it.
// Tested by tests/runtime/agreement_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/compare/metrics.h"
#include "runtime/simulate/propagate.h"

namespace twincraft {

/// A running maximum that a NaN wins for good: a comparison that can not be made never passes.
struct Peak {
  double maximum = 0.0;
  double at = 0.0;  // [s] when it first occurred

  void see(double value, double time);
};

/// One quantity compared, in the unit its key ends in.
struct Metric {
  std::string key;                  // `attitude_deg`, as in report.json
  double maximum = 0.0;             // not finite when a sample was not
  double at = 0.0;                  // [s]
  std::optional<double> tolerance;  // nothing: reported, not judged
  double size = 0.0;                // the largest that either run had of the quantity itself

  /// Nothing when there is no tolerance.
  std::optional<bool> pass() const;
};

struct Comparison {
  std::vector<Metric> metrics;  // those that apply to the vehicle; none without common samples
  bool same_times = false;      // both trajectories were sampled at the same instants throughout
};

/// A comparison made while pairs of samples come.
class AgreementMeter {
 public:
  explicit AgreementMeter(std::vector<MetricLaw> laws);

  /// Two samples of one instant.
  void take(const Observation& a, const Observation& b);

  /// Every law's difference in the last pair, in the unit its key ends in.
  const std::vector<double>& now() const { return now_; }

  /// @param same_times  no sample was left without a partner
  Comparison result(bool same_times) const;

 private:
  std::vector<MetricLaw> laws_;
  std::vector<double> now_;
  std::vector<Peak> peaks_;
  std::vector<double> sizes_;
  std::size_t pairs_ = 0;
};

/// Compares the samples both trajectories have, from the start to the first that differ in time.
Comparison compare(const Model& model, const Trajectory& a, const Trajectory& b);

/// The hub alone, of two runs by one engine of machines that need not be the same: attitude and
/// rate (unless `translation`), position, velocity and the system's centre of mass. Nothing is
/// judged.
Comparison compare_hubs(bool translation, const Trajectory& a, const Trajectory& b);

}  // namespace twincraft
