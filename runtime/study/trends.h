// What a sweep shows as a whole: how an error follows the step, how the cost follows the size of
// the machine, how a disagreement follows a parameter. All three are exponents between neighbours:
// log(y2 / y1) / log(x2 / x1). Tested by tests/runtime/sweep_test.cpp.
#pragma once

#include <compare>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "compiler/ir/study.h"
#include "runtime/study/member.h"

namespace twincraft {

/// A number that members have in common.
struct StudyQuantity {
  std::string reference;  // `kepler`; empty: the difference of the engines
  std::string engine;     // `bsm`; empty: both
  std::string metric;     // `attitude_deg`; empty: microseconds a step
  auto operator<=>(const StudyQuantity&) const = default;
};

/// What a member has of a quantity.
struct Figure {
  const StudyQuantity* quantity = nullptr;
  double value = 0.0;
  double rounding = 0.0;  // up to here the value is rounding; 0: nothing is known of that
};

/// Where an engine came to in a run to its end.
struct EngineEnd {
  std::string engine;  // "bsm"
  Quaterniond q_BN;
  Vector3d r_BN_N;
  long evaluations = 0;
  std::optional<double> median;  // [s] when it was timed
};

/// A member as far as a study looks at it: few numbers, as there may be a million of them.
struct StudyPoint {
  std::vector<Setting> settings;  // those of the study come last
  double step = 0.0;              // [s]
  int degrees_of_freedom = 0;
  std::size_t member = 0;  // its number in the study
  bool in_fits = true;     // it has neither failed nor is it unresolved
  std::vector<Figure> figures;
  std::vector<EngineEnd> ends;  // for work against precision
};

/// The members of a study, one after another.
class StudyPoints {
 public:
  /// @param keep_ends  whether work is to be held against precision
  void add(const std::vector<Setting>& settings, const Model& model, const Member& member,
           bool keep_ends);

  const std::vector<StudyPoint>& all() const { return all_; }

  StudyPoints() = default;
  StudyPoints(StudyPoints&&) = default;
  StudyPoints& operator=(StudyPoints&&) = default;

 private:
  void add_figure(StudyQuantity quantity, double value, double rounding, StudyPoint& point);

  std::set<StudyQuantity> quantities_;  // what points refer to
  std::vector<StudyPoint> all_;
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
  std::vector<bool> is_rounding;     // of each x and y: y is no more than rounding
  std::vector<double> exponents;  // one less; NaN where a logarithm does not exist, or of rounding

  /// Some exponent can be told.
  bool has_exponents() const;
};

/// Errors against references, or the difference of the engines where there is none, over the step
/// [s], for every sweep of `simulation.step`.
std::vector<Trend> convergence_of(const StudyPlan& plan, const StudyPoints& points);

/// Time of a step [us] over the number of coordinates, where a sweep changes that.
std::vector<Trend> scaling_of(const StudyPlan& plan, const StudyPoints& points);

/// Difference of the engines over any other swept number (SI; of a vector its norm).
std::vector<Trend> slopes_of(const StudyPlan& plan, const StudyPoints& points);

/// The last setting of `path`: a study's come after the command line's.
const Setting* find_setting(const std::vector<Setting>& settings, const std::string& path);

}  // namespace twincraft
