// A spec that was compiled for use by a program: never changed, shared by all that fly it.
// Tested by tests/api/simulation_test.cpp.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "compiler/pipeline.h"
#include "runtime/api/signal_list.h"
#include "runtime/engine/observation.h"

namespace twincraft::api {

class CompiledModel {
 public:
  /// @throws Fault: the spec has errors (in `diagnostics`), or cannot be read
  static std::shared_ptr<const CompiledModel> load(const CompileRequest& request,
                                                   Diagnostics& diagnostics);

  CompiledModel(LoadedSpec spec, Bundle bundle);
  CompiledModel(const CompiledModel&) = delete;
  CompiledModel& operator=(const CompiledModel&) = delete;

  const LoadedSpec& spec() const { return spec_; }
  const Bundle& bundle() const { return bundle_; }
  const Model& model() const { return bundle_.model; }
  /// A member of its campaign, drawn. @throws Fault as load(): what was drawn is no vehicle
  std::shared_ptr<const CompiledModel> member(std::size_t index, Diagnostics& diagnostics) const;
  /// SHA-256 of the resolved spec: whoever has the same has the same vehicle.
  const std::string& digest() const { return bundle_.emitted.at(kResolved).sha256; }

  const SignalList& inputs() const { return inputs_; }
  const SignalList& outputs() const { return outputs_; }
  const SignalList& states() const { return states_; }
  /// What stands behind the numbers of outputs() and states().
  const std::vector<OutputSignal>& output_signals() const { return output_signals_; }
  const std::vector<OutputSignal>& state_signals() const { return state_signals_; }

  /// All links together at t = 0, B axes.
  MassProperties mass_properties() const;

 private:
  LoadedSpec spec_;
  Bundle bundle_;
  std::vector<OutputSignal> output_signals_, state_signals_;
  SignalList inputs_, outputs_, states_;
};

/// @throws Fault(TC_SPEC): it has none
const CampaignPlan& campaign_of(const CompiledModel& model);

/// Set `numbers` to what a sample shows of `signals`. @pre sizes fit
void read_signals(const std::vector<OutputSignal>& signals, const Observation& seen,
                  std::span<double> numbers);
/// The state that numbers in the order of state_signals() say. @throws Fault: not finite, or an
/// attitude of no length
VehicleState state_from(const CompiledModel& model, std::span<const double> numbers);

}  // namespace twincraft::api
