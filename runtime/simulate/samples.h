// When a run is sampled, and what a sample must not be.
// Tested by tests/runtime/propagate_test.cpp.
#pragma once

#include "runtime/engine/observation.h"

namespace twincraft {

/// At 0, and at the first landing at or after each multiple of the plan's `record`; at stored
/// times, too.
class SampleTimes {
 public:
  /// `model` must outlive it. @param tolerance  [s] closer instants are one
  SampleTimes(const Model& model, double tolerance) : model_(model), tolerance_(tolerance) {}
  bool at(double landing) const;
  void taken(double landing);

 private:
  const Model& model_;
  double tolerance_;
  double next_ = 0.0;
};

/// A state may be finite and still no motion. @throws NumericalFailure
void refuse_absurd(const Observation& seen, const Model& model);

}  // namespace twincraft
