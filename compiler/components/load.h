// A force and a torque fixed in the axes of a mount: a push, a disturbance, a test torque.
// Tested by tests/compiler/loads_test.cpp.
#pragma once

#include <array>
#include <optional>
#include <variant>

#include "compiler/components/section.h"

namespace twincraft {

/// The word `com`: the system centre of mass, wherever it is at the time.
enum class LoadPoint { kSystemCom };

struct LoadSpec : Written {
  std::string name;
  std::string mount = "hub";
  std::array<Schedule, 3> force;                                        // [N] mount axes
  std::array<Schedule, 3> torque;                                       // [N m] mount axes
  std::variant<LoadPoint, Vector3d> position{Vector3d(0.0, 0.0, 0.0)};  // [m] mount axes
  std::optional<std::vector<Schedule::Interval>> during;                // absent: always
};

const Table<LoadSpec>& load_table();

/// Its mount exists, and it acts in the run.
void check(const LoadSpec& load, const Context& context, Diagnostics& diagnostics);

/// Intervals are folded into the schedules.
void lower(const LoadSpec& load, const Vehicle& vehicle, ModelBuilder& builder);

/// Its force acts on a point as well.
inline bool fits_point_mass(const LoadSpec&) { return true; }

}  // namespace twincraft
