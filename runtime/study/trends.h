// What a sweep shows as a whole: how an error follows the step, how the cost follows the size of
// the machine, how a disagreement follows a parameter. All three are exponents between neighbours:
// log(y2 / y1) / log(x2 / x1). Tested by tests/runtime/sweep_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "compiler/ir/study.h"
#include "runtime/study/run.h"

namespace twincraft {

/// A member as far as a study looks at it.
struct StudyPoint {
  const std::vector<Setting>* settings = nullptr;  // those of the study come last
  double step = 0.0;                               // [s]
  int degrees_of_freedom = 0;
  const Member* result = nullptr;
  std::size_t member = 0;  // its number in the study
};

/// One quantity along one path of a sweep, with everything else equal.
struct Trend {
  std::string path;             // what is varied
  std::vector<Setting> others;  // the other paths of a grid, where they stood
  std::string reference;        // `kepler`; empty: the difference of the engines
  std::string engine;           // `bsm`; empty: both
  std::string metric;           // `attitude_deg`
  std::vector<double> x, y;
  std::vector<std::size_t> members;  // of which each x and y is
  std::vector<double> exponents;     // one less; NaN where a logarithm does not exist
};

/// Errors against references, or the difference of the engines where there is none, over the step
/// [s], for every sweep of `simulation.step`.
std::vector<Trend> convergence_of(const StudyPlan& plan, const std::vector<StudyPoint>& points);

/// Time of a step [us] over the number of coordinates, where a sweep changes that.
std::vector<Trend> scaling_of(const StudyPlan& plan, const std::vector<StudyPoint>& points);

/// Difference of the engines over any other swept number (SI; of a vector its norm).
std::vector<Trend> slopes_of(const StudyPlan& plan, const std::vector<StudyPoint>& points);

/// The last setting of `path`: a study's come after the command line's.
const Setting* find_setting(const std::vector<Setting>& settings, const std::string& path);

}  // namespace twincraft
