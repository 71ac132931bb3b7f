// The compiled spec behind twincraft.Model.
#pragma once

#include <nanobind/nanobind.h>
#include <twincraft/simulation.h>

#include <string>
#include <vector>

#include "runtime/api/python/signals.h"

namespace twincraft::python {

namespace nb = nanobind;

class CompiledModel {
 public:
  explicit CompiledModel(twincraft::Model compiled)
      : model(std::move(compiled)),
        inputs(model, TC_INPUTS),
        outputs(model, TC_OUTPUTS),
        states(model, TC_STATES) {}

  /// About what a step takes [us]: whether it is worth letting other threads of Python go on.
  double step_cost(twincraft::Engine engine) const {
    const double n = model.degrees_of_freedom();
    return engine == twincraft::Engine::bsm ? 0.1 + 0.06 * n : 0.5 * n + 0.012 * n * n;
  }

  /// About what a member of a campaign takes, compiled and flown by the analytic engine [s].
  double member_cost() const {
    return 1e-4 + 1e-6 * step_cost(twincraft::Engine::bsm) * model.duration() / model.step();
  }

  twincraft::Model model;
  Signals inputs, outputs, states;
};

/// A text that says `bsm` or `mujoco`. @throws ValueError
twincraft::Engine engine_named(const std::string& name);

void bind_model(nb::module_& module);
void bind_flyers(nb::module_& module);
void bind_batch(nb::module_& module);
void bind_campaign(nb::module_& module);

}  // namespace twincraft::python
