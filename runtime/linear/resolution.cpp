#include "runtime/linear/resolution.h"

#include <array>

#include "runtime/linear/judge.h"

namespace twincraft {

std::string_view rule_name(ResolutionRule rule) {
  constexpr std::array<std::string_view, 8> kNames{"stability", "modal_error", "attitude",
                                                   "probes",    "translation", "rotation",
                                                   "energy",    "adaptive"};
  return kNames[static_cast<std::size_t>(rule)];
}

EnergyFigures figures_of(const OwnEnergy& energy) {
  return {energy.exchanged(), energy.drift(), energy.relative()};
}

Resolution judge_resolution(const Model& model, const Inspection& inspection, const RunShown& run,
                            std::span<const OwnEnergy* const> energies) {
  Judge judge(model, inspection, run);
  judge.look_at_modes();
  if (is_adaptive(model))
    judge.look_at_accepted_errors();
  else
    judge.look_at_probes();
  judge.look_at_motion(energies);
  return judge.conclude();
}

Resolution foresee_resolution(const Model& model) {
  if (is_adaptive(model)) return {};
  const Inspection inspection = plan_inspection(model);
  const std::vector<Observation> instants = foreseen(model, inspection);
  const RunShown run{nullptr, instants, model.simulation.duration, 0.0, {}};
  Judge judge(model, inspection, run);
  judge.look_at_modes();
  return judge.conclude();
}

Resolution explain_failure(const Model& model, const Inspection& inspection, const RunShown& run) {
  // What is seen late in such a run is what is left of the vehicle: what was foreseen tells, if it
  // can. The step that failed ends after the last good state.
  const double failed = run.reached + (is_adaptive(model) ? run.mean_step : model.simulation.step);
  const std::vector<Observation> instants = foreseen(model, inspection);
  RunShown before = run;
  before.instants = instants;
  before.reached = model.simulation.duration;
  before.motion = nullptr;
  Judge judge(model, inspection, before);
  judge.set_destroyed(failed);
  judge.look_at_modes();
  const Resolution told_before = judge.conclude_failure();
  if (!told_before.reasons.empty()) return told_before;
  Judge later(model, inspection, run);
  later.look_at_modes();
  return later.conclude_failure();
}

}  // namespace twincraft
