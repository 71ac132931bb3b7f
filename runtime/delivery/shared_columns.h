// What two trajectories have in common: columns of one name, the quantities of ours among them, and
// what the units of each file are in one unit. Nothing is guessed: a column of ours without a unit,
// or with one of another quantity, is a fault.  Tested by tests/runtime/compare_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "runtime/compare/metrics.h"
#include "runtime/delivery/trajectory_reader.h"

namespace twincraft {

/// A column that both files have.
struct SharedColumn {
  std::string name;
  std::string unit;  // that both are compared in
  std::size_t a = 0, b = 0;
  double factor_a = 1.0, factor_b = 1.0;  // of each file's unit to it
};

struct SharedColumns {
  /// A number of an output that some metric is taken from.
  struct Measured {
    SharedColumn column;
    OutputSignal output;
    std::size_t component = 0;
  };

  Model model;  // the spec's; without one, the coordinates that the columns name
  std::vector<MetricLaw> laws;
  std::vector<Measured> measured;
  std::vector<SharedColumn> others;  // compared one by one
  std::vector<std::string> only_a, only_b;
  std::vector<std::string> incomparable;  // of other names, whose units are missing or different
  std::vector<std::string> unjudged;      // keys of metrics with a tolerance, and not in both files

  bool empty() const { return measured.empty() && others.empty(); }
};

/// @param spec    says which coordinates there are and what is tolerated; null: columns say the
///                coordinates. A rate without a position is a wheel's, `NAME.phi` and `NAME.theta`
///                are a pendulum's, other angles are joints', lengths displacements
/// @param faults  gains what is wrong with the columns of either file
SharedColumns share_columns(const TrajectoryReader& a, const TrajectoryReader& b, const Model* spec,
                            std::vector<FileFault>& faults);

}  // namespace twincraft
