// A study: many runs of one spec that differ in the values at a few spec paths. Either a sweep, in
// which every member sets one value per path, or a work-precision study, in which every member is
// one integrator at one step or tolerance and is held against a tight reference.
// Tested by tests/compiler/study_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/ir/study.h"
#include "compiler/spec/outputs.h"
#include "compiler/spec/simulation.h"
#include "compiler/syntax/overrides.h"

namespace twincraft {

inline constexpr std::size_t kMaximumMembers = 1'000'000;

struct SweepSpec : Written {
  std::string set;  // a spec path
  std::vector<Node> values;
};

enum class Combine { kGrid, kZip };

/// One integrator at several steps or tolerances.
struct ConfigurationSpec : Written {
  Method integrator = Method::kRk4;
  std::optional<double> step;  // [s] of an adaptive method; absent: the spec's
  std::string set;
  std::vector<Node> values;
};

/// The run whose final state counts as the truth, one for each engine.
struct TightRunSpec : Written {
  Method integrator = Method::kRkf78;
  std::optional<double> step;  // [s] absent: the spec's
  double tolerance = 1.0e-13;
};

struct FloorCheckSpec : Written {
  double tolerance = 1.0e-12;
};

struct WorkPrecisionSpec : Written {
  std::vector<ConfigurationSpec> configurations;
  TightRunSpec reference;
  FloorCheckSpec check;
};

struct StudySpec : Written {
  std::vector<SweepSpec> sweep;
  Combine combine = Combine::kGrid;
  std::optional<std::string> compare;  // one of the swept paths
  std::optional<WorkPrecisionSpec> work_precision;
  std::vector<OutputSpec> outputs;  // of a sweep; planned when the model is there
};

const Table<StudySpec>& study_table();

/// A study with its paths parsed: any member can be asked for, none is kept.
struct StudyMembers {
  struct Axis {
    std::vector<std::string> path;
    Span span;
    std::vector<Node> values;
  };
  StudyPlan plan;
  std::vector<Axis> axes;                     // of a sweep
  std::vector<std::vector<Override>> listed;  // of a work-precision study

  /// What member `index` sets, in the order in which it is applied: of a grid, the last path varies
  /// fastest. @pre index < plan.members
  std::vector<Override> overrides(std::size_t index) const;
};

/// Report bad paths, paths that a study cannot change or sets twice, lists of unequal length, and
/// too many members; nothing when there was an error.
std::optional<StudyMembers> members_of(const StudySpec& study, Diagnostics& diagnostics);

/// What an override sets, as it was written.
Setting setting_of(const Override& override);

}  // namespace twincraft
