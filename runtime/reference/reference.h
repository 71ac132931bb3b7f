// Exact answers that a run can be compared with: does the vehicle have one, and how far from it are
// the samples. Each reference starts from the first sample and shares nothing with the engines.
// Tested by tests/runtime/reference_test.cpp.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/ir/model.h"
#include "runtime/observation.h"

namespace twincraft {

/// The largest deviation over all samples, and the time [s] of the sample that has it.
struct Deviation {
  std::string metric;  // ends in its unit: `position_m`, `attitude_deg`
  double max = 0.0;
  double at = 0.0;
};

std::string_view reference_name(ReferenceKind kind);  // as in the spec

/// Why `kind` is not the exact motion of `model` under the gravity law of the engine that is
/// judged; nothing when it is.
std::optional<std::string> inapplicable(ReferenceKind kind, const Model& model, GravityLaw law);

/// @pre inapplicable() has no objection; samples are not empty and samples[0] is the state at t = 0
std::vector<Deviation> deviations(ReferenceKind kind, const Model& model,
                                  std::span<const Observation> samples);

/// Keep the larger of `deviation` and a sample's `found` at `time`; NaN counts as larger.
void widen(Deviation& deviation, double found, double time);

/// Every kilogram sits at the vehicle's centre of mass for good, in either half of the model, so
/// that a force on each element is one force at C and has no torque about it.
bool all_mass_at_one_point(const Model& model);

}  // namespace twincraft
