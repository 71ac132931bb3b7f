// When a run is sampled, and what a sample must not be.
// Tested by tests/runtime/propagate_test.cpp.
#pragma once

#include <span>

#include "runtime/engine/observation.h"
#include "runtime/engine/state.h"

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
  double count_ = 0.0;  // of intervals until the next
  double next_ = 0.0;   // [s]
};

/// A state may be finite and still no motion. @param state  and perhaps more behind it
/// @throws NumericalFailure
void refuse_absurd(std::span<const double> state, const StateLayout& layout, const Model& model);

}  // namespace twincraft
