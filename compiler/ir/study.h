// What the members of a study differ in, as the runtime and the report see it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "compiler/ir/campaign.h"

namespace twincraft {

/// A change to the spec: by the command line or by a study.
struct Setting {
  std::string path;  // `engines.mujoco.wheel_mass`
  std::string text;  // the value as it was written, or as JSON when it is a list or a map
  // Where it led to a number: in SI, the Euclidean norm of a vector.
  std::optional<double> value = std::nullopt;
};

/// Members differ in the values at a few paths.
struct StudyPlan {
  std::size_t members = 0;
  std::vector<std::string> paths;  // of a sweep, in its order
  bool is_grid = true;             // every combination; else all paths step together
  // The last two members are the reference and the check of its floor, the others are the
  // configurations that are held against them.
  bool is_work_precision = false;
  std::vector<std::size_t> lengths = {};  // how many values each path takes
  // Every member is held, engine by engine, against the one that has the first value of this path
  // and all else equal; of a zip, against the first member.
  std::optional<std::size_t> compare = {};  // its place in `paths`
  std::vector<OutputPlan> outputs = {};     // of a sweep

  /// The member that `member` is held against: itself where it has the first value.
  /// @pre compare; paths and lengths are of one size
  std::size_t baseline_of(std::size_t member) const;
  /// The last member that is held against `baseline`. @pre as above; baseline_of(baseline) is
  /// itself
  std::size_t last_held_against(std::size_t baseline) const;
};

}  // namespace twincraft
