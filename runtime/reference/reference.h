// How far a run is from an exact answer. Each reference starts from the first sample and shares
// nothing with the engines; whether a vehicle has one is decided in compiler/analysis/truth.
// Tested by tests/runtime/reference_test.cpp.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compiler/analysis/truth.h"
#include "runtime/engine/observation.h"

namespace twincraft {

/// The largest deviation over all samples, and the time [s] of the sample that has it.
struct Deviation {
  std::string metric;  // ends in its unit: `position_m`, `attitude_deg`
  double max = 0.0;
  double at = 0.0;
  std::optional<double> tolerance = {};  // in the unit of the metric; nothing: not judged

  /// Nothing when there is no tolerance.
  std::optional<bool> pass() const;
  /// What a sample at `time` shows; NaN counts as larger.
  void see(double found, double time);
};

/// @pre inapplicable() has no objection; samples are not empty and samples[0] is the state at t = 0
std::vector<Deviation> deviations(ReferenceKind kind, const Model& model,
                                  std::span<const Observation> samples);

}  // namespace twincraft
