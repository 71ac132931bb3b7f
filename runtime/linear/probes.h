// A few steps of a run repeated at half the step: what Richardson's extrapolation says each step
// gets wrong. Sees what no linear model does. The analytic engine in the quaternion chart stands
// for both engines: they share the motion and the method.
#pragma once

#include <memory>
#include <vector>

#include "compiler/ir/model.h"
#include "runtime/engine/engine.h"
#include "runtime/integrate/engine_ode.h"

namespace twincraft {

/// The local error of one step, estimated.
struct LocalError {
  double attitude = 0.0;      // [rad]
  double center = 0.0;        // [m] of the system's centre of mass
  std::vector<double> joint;  // [rad] or [m], magnitudes
};

class Prober {
 public:
  /// @param model  outlives it
  explicit Prober(const Model& model);

  /// Of one step of `h` [s] from the state of `seen`, with its inputs. Not finite when the step is
  /// far too long.
  LocalError probe(const Observation& seen, double h);

 private:
  Observation stepped(const Observation& seen, double h, int steps);

  double factor_;  // of the difference of one step and two half steps
  InputFeed feed_;
  std::unique_ptr<Engine> engine_;
  EngineOde ode_;
  RungeKutta stepper_;
};

}  // namespace twincraft
