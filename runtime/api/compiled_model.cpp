// See compiled_model.h.
#include "runtime/api/compiled_model.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "compiler/analysis/configuration.h"
#include "compiler/diag/print.h"
#include "runtime/api/faults.h"
#include "runtime/delivery/compiled_spec.h"
#include "runtime/engine/observation.h"

namespace twincraft::api {

std::shared_ptr<const CompiledModel> CompiledModel::load(const CompileRequest& request,
                                                         Diagnostics& diagnostics) {
  Compilation made = compile_spec(request, wanted_by_run(true), diagnostics);
  if (!made.io_error.empty()) throw Fault(TC_FILE, made.io_error);
  if (made.bad_override) refuse(to_text(diagnostics, {}));
  if (!made.compiled) throw Fault(TC_SPEC, to_text(diagnostics, {}));
  return std::make_shared<CompiledModel>(std::move(made.compiled->spec),
                                         std::move(made.compiled->bundle));
}

CompiledModel::CompiledModel(LoadedSpec spec, Bundle bundle)
    : spec_(std::move(spec)),
      bundle_(std::move(bundle)),
      output_signals_(outputs_of(bundle_.model)),
      state_signals_(motion_of(bundle_.model)),
      inputs_("input", inputs_of(bundle_.model)),
      outputs_("output", output_signals_),
      states_("state", state_signals_) {}

std::shared_ptr<const CompiledModel> CompiledModel::member(std::size_t index,
                                                           Diagnostics& diagnostics) const {
  return load(
      {fmt::format("<member {}>", index), spec_.campaign_settings(index), bundle_.text(kResolved)},
      diagnostics);
}

MassProperties CompiledModel::mass_properties() const {
  const VehicleState& start = model().initial;
  return system_properties(model().assembly,
                           configuration(model().assembly, start.joint_position, start.joint_rate));
}

const CampaignPlan& campaign_of(const CompiledModel& model) {
  if (const CampaignPlan* plan = model.spec().campaign()) return *plan;
  throw Fault(TC_SPEC, fmt::format("`{}` has no `campaign`", model.model().name));
}

void read_signals(const std::vector<OutputSignal>& signals, const Observation& seen,
                  std::span<double> numbers) {
  std::size_t next = 0;
  for (const OutputSignal& signal : signals)
    for (std::size_t i = 0; i < signal.size(); ++i) numbers[next++] = value_of(signal, i, seen);
}

VehicleState state_from(const CompiledModel& model, std::span<const double> numbers) {
  if (numbers.size() != model.states().size())
    refuse(fmt::format("a state of `{}` has {} numbers, not {}", model.model().name,
                       model.states().size(), numbers.size()));
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!std::isfinite(numbers[i]))
      refuse(fmt::format("`{}` is not finite", model.states().name(i)));
  VehicleState state = model.model().initial;
  std::size_t next = 0;
  for (const OutputSignal& signal : model.state_signals()) {
    set_value(signal, numbers.subspan(next, signal.size()), state);
    next += signal.size();
  }
  const double length = state.q_BN.norm();
  if (!(length > 1e-6)) refuse("`q_BN` is no attitude: its length is 0");
  state.q_BN.normalize();
  return state;
}

}  // namespace twincraft::api
