// What accuracy costs: each configuration's final state against a tight run of the same engine.
// Errors below the floor, the difference of two tight runs, mean nothing.
// Tested by tests/runtime/sweep_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/study/trends.h"

namespace twincraft {

/// How far one final state of an engine is from another.
struct FinalError {
  double attitude = 0.0;  // [deg]
  double position = 0.0;  // [m] of the hub's origin
};

struct WorkPoint {
  std::size_t member = 0;
  bool diverged = false;  // no final state, or not a finite one: the rest does not hold
  FinalError error;
  long evaluations = 0;
  std::optional<double> median;  // [s] when it was timed
  bool on_frontier = false;      // every cheaper configuration has a larger attitude error
};

struct EngineWork {
  std::string engine;
  FinalError floor;
  std::vector<WorkPoint> points;  // of the configurations, in their order
};

/// Engines whose reference and check did not end well are left out.
/// @pre the last two points are the reference and the check
std::vector<EngineWork> work_precision_of(const StudyPoints& points);

/// Sentences about adaptive methods whose tolerance changes nothing, since the interval at which
/// they land is shorter than the step it asks for.
std::vector<std::string> idle_tolerances(const EngineWork& work, const StudyPoints& points);

/// In how many configurations that both completed and that were timed the first engine was faster.
struct Faster {
  int first = 0;
  int of = 0;
};
Faster compare_cost(const EngineWork& first, const EngineWork& second);

}  // namespace twincraft
