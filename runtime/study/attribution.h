// Why do the two engines differ? Every cause that applies is taken away alone, and what goes with
// it is its share; it is scaled, and what it then does is its law; all are taken away together, and
// what is left is rounding, the integrator's error or unexplained. Knows variants of a spec as
// changes to it and as the error series that came of them; running them is the caller's.
// Tested by tests/runtime/attribution_test.cpp and tests/agreement/attribution_test.cpp.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/compare/agreement.h"
#include "runtime/compare/error_series.h"
#include "runtime/study/causes.h"

namespace twincraft {

/// What is explained.
struct Subject {
  std::string metric;     // `attitude_deg`, `com_position_m`, `joint_deg`
  double unit = 1.0;      // the metric's units per SI unit
  double rounding = 0.0;  // SI: one unit in the last place of the quantity per step, all one way
  std::optional<std::size_t> joint = {};  // entry of the joint vector
  std::string coordinate = {};            // its name
  double mujoco_rounding = 0.0;           // SI: mujoco_rounding() of the run, once it is asked
};

/// The subjects of a vehicle in the order in which they are looked at: attitude, if it has one,
/// then the system's centre of mass, then of all joints the one that is farthest out of rounding.
std::vector<Subject> subjects_of(const Model& model, const Trajectory& a, const Trajectory& b);

ErrorSeries error_of(const Subject& subject, const Trajectory& a, const Trajectory& b);

/// How a cause's contribution to the difference follows its variable.
struct ScalingLaw {
  std::string variable;               // `wheel mass`
  double exponent = 0.0;              // least squares over the points that stand out of the noise
  std::vector<double> factors;        // of the variable, largest first
  std::vector<double> contributions;  // in the metric's unit
};

/// Numbers in the metric's unit; NaN where a variant could not be run to its end.
struct AttributedCause {
  Cause cause;
  double share = 0.0;            // share(): of the difference as it is, 1 is all of it
  double maximum_without = 0.0;  // the difference with this cause alone taken away
  std::optional<ScalingLaw> law;
  std::string no_law;         // why not
  double maximum_left = 0.0;  // with this cause and all before it taken away
};

/// kMujocoRounding: within what MuJoCo's inertias about the vehicle's centre of mass may round to.
/// kUnknown: the variant without any cause could not be run to its end.
enum class Remainder { kRounding, kIntegrator, kMujocoRounding, kUnexplained, kUnknown };

struct Attribution {
  Subject subject;
  double maximum = 0.0;                   // of the spec as it is, in the metric's unit
  bool is_rounding = false;               // there is nothing to explain: no cause was looked at
  std::vector<AttributedCause> causes;    // by the size of the share, the largest first
  double remainder = 0.0;                 // with all causes taken away, in the metric's unit
  std::optional<double> remainder_order;  // in the step, when it is more than rounding
  Remainder kind = Remainder::kRounding;
  std::string failure;    // the first variant that could not be run: why
  bool complete = false;  // every variant was run to its end
};

/// What came of a variant: its error, or why there is none.
struct VariantResult {
  std::optional<ErrorSeries> error;
  std::string failure;
};

/// Results in the order of the variants.
using RunVariants = std::function<std::vector<VariantResult>(const std::vector<Overrides>&)>;

/// @param as_is  the error of `bundle` itself, which came of a run to its end
Attribution attribute(const Bundle& bundle, const Subject& subject, ErrorSeries as_is,
                      const RunVariants& run);

}  // namespace twincraft
