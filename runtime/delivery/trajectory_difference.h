// Two trajectory files compared at their common times: both are read side by side, a sample at a
// time, so files of any length take the same memory.  Tested by tests/runtime/compare_test.cpp.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "runtime/compare/agreement.h"
#include "runtime/delivery/shared_columns.h"

namespace twincraft {

/// What one of the files has that says something about the comparison.
struct ComparedFile {
  std::string name;
  std::size_t lone_times = 0;  // that the other file has not
  double first_lone = 0.0;     // [s]
  NotFinite not_finite = {};
  std::size_t null_attitudes = 0;  // quaternions of length 0, which are no attitude
  double first_null = 0.0;         // [s]
};

/// A column that no metric is taken from.
struct ColumnDifference {
  std::string name, unit;
  Peak peak;
};

struct TrajectoryDifference {
  ComparedFile a, b;
  SharedColumns shared;
  std::size_t times = 0;                     // in common
  double first_time = 0.0, last_time = 0.0;  // of these [s]
  Comparison comparison;
  std::vector<ColumnDifference> others;
};

/// How much of the files has been read, 0 to 1.
using CompareProgress = std::function<void(double fraction)>;

/// What the system says of a file, in lower case as all our messages.
std::string reason_of(const std::error_code& fault);

/// @param spec    null: see share_columns()
/// @param faults  gains what is wrong with the files
/// @return nothing with faults
std::optional<TrajectoryDifference> compare_trajectories(const std::string& a, const std::string& b,
                                                         const Model* spec,
                                                         std::vector<FileFault>& faults,
                                                         const CompareProgress& progress = {});

}  // namespace twincraft
