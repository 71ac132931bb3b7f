// What the members of a study differ in, as the runtime and the report see it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

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
};

}  // namespace twincraft
