// How the run is made: integrator, step, tolerances, duration, records. The step is a time, or a
// rule in terms of a component's own period, which follows the component through a sweep.
// Tested by tests/compiler/simulation_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "compiler/components/section.h"
#include "compiler/ir/model.h"

namespace twincraft {

enum class SimulationMode {
  kFull,
  kTranslation,  // a point mass without attitude
};

/// min(maximum, period of `of` / per_period), and never so long that its dampers are unstable
struct StepRule : Written {
  double per_period = 0.0;
  std::string of;                 // a panel, particle or pendulum
  std::optional<double> maximum;  // [s]
};

struct AbsoluteRelative : Written {
  double absolute = 0.0;  // unit of the block
  double relative = 0.0;
};

/// A plain number is both parts.
using ToleranceSpec = std::variant<AbsoluteRelative, double>;

inline constexpr double kDefaultTolerance = 1.0e-9;

struct BlockTolerancesSpec : Written {
  ToleranceSpec position{kDefaultTolerance};    // [m]
  ToleranceSpec velocity{kDefaultTolerance};    // [m/s]
  ToleranceSpec attitude{kDefaultTolerance};    // components of the chart
  ToleranceSpec rate{kDefaultTolerance};        // [rad/s]
  ToleranceSpec joint{kDefaultTolerance};       // [rad] or [m]
  ToleranceSpec joint_rate{kDefaultTolerance};  // [rad/s] or [m/s]
  ToleranceSpec wheel{kDefaultTolerance};       // [rad/s]
};

struct SimulationSpec : Written {
  SimulationMode mode = SimulationMode::kFull;
  Method integrator = Method::kRk4;
  std::variant<StepRule, double> step{0.01};  // [s]
  std::variant<BlockTolerancesSpec, double> tolerance{kDefaultTolerance};
  double duration = 10.0;        // [s]
  std::optional<double> record;  // [s] absent: about 200 samples
  bool judges_resolution = true;
};

const Table<SimulationSpec>& simulation_table();

/// The step in force [s]. @pre check passed
double step_of(const SimulationSpec& simulation, const std::vector<Oscillator>& oscillators);

/// Steps must be shorter than the run, rules must find something with a period, and tolerances must
/// be reachable in double precision. A step that does not divide the duration is a warning.
/// @param coordinates  of joints and wheels: what a record is a record of
void check(const SimulationSpec& simulation, const std::vector<Oscillator>& oscillators,
           int coordinates, Diagnostics& diagnostics);

SimulationPlan lower(const SimulationSpec& simulation, const std::vector<Oscillator>& oscillators);

}  // namespace twincraft
