// The order of a member's work; each part lives in its own file.
// Tested by tests/agreement/scsim_test.cpp.
#include "runtime/study/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "compiler/ir/number.h"
#include "runtime/bsm/engine.h"
#include "runtime/mujoco/engine.h"

namespace twincraft {
namespace {

using Status = EngineRun::Status;

bool is_bsm(std::string_view engine) { return engine == "bsm"; }

bool stopped(const RunOptions& options) { return options.stop != nullptr && *options.stop; }

void show(const RunOptions& options, std::string_view phase, double fraction) {
  if (options.progress) options.progress(phase, fraction);
}

std::unique_ptr<Engine> build(std::string_view engine, const Bundle& bundle) {
  return is_bsm(engine) ? make_bsm_engine(bundle.model)
                        : make_mujoco_engine(bundle.model, bundle.mjcf);
}

/// Why an engine is not run at all; empty when it is.
std::string skip_reason(std::string_view engine, const Model& model, const RunOptions& options) {
  if (!(is_bsm(engine) ? options.bsm : options.mujoco)) return "not asked for";
  if (stopped(options)) return "interrupted";
  return is_bsm(engine) ? "" : model.mujoco_refusal;
}

PropagateOptions watched(std::string_view engine, double duration, const RunOptions& options) {
  return {options.stop,
          [engine, duration, &options](double time) { show(options, engine, time / duration); }};
}

void conclude(EngineRun& run) {
  const Trajectory& trajectory = run.trajectory;
  run.conservation = conservation_of(trajectory);
  if (trajectory.status == Trajectory::Status::kFailed) {
    run.status = Status::kFailed;
    run.reason = trajectory.failure;
  } else if (trajectory.status == Trajectory::Status::kInterrupted) {
    run.reason = fmt::format("interrupted at t = {} s", shortest(trajectory.t_end));
  }
}

EngineRun run_engine(std::string_view name, const Bundle& bundle, const RunOptions& options) {
  EngineRun run;
  run.name = name;
  run.reason = skip_reason(name, bundle.model, options);
  if (!run.reason.empty()) {
    run.status = Status::kSkipped;
    return run;
  }
  try {
    const std::unique_ptr<Engine> engine = build(name, bundle);
    run.trajectory =
        propagate(*engine, bundle.model, watched(name, bundle.model.simulation.duration, options));
    conclude(run);
  } catch (const NumericalFailure& failure) {  // it could not even be built or observed
    run.status = Status::kFailed;
    run.reason = failure.what();
  }
  return run;
}

std::vector<ReferenceRun> hold_against_references(const Model& model,
                                                  const std::vector<EngineRun>& engines) {
  std::vector<ReferenceRun> runs;
  for (ReferenceKind kind : model.references)
    for (const EngineRun& engine : engines)
      if (!engine.trajectory.samples.empty())
        runs.push_back({std::string(reference_name(kind)), engine.name,
                        deviations(kind, model, engine.trajectory.samples)});
  return runs;
}

bool ran_through(const EngineRun& engine) {
  return engine.status == Status::kOk && engine.trajectory.status == Trajectory::Status::kComplete;
}

/// Of the engines that ran through: a broken run has no cost worth comparing.
Timing time_member(const Bundle& bundle, const std::vector<EngineRun>& engines,
                   const RunOptions& options) {
  std::vector<TimedEngine> contestants;
  for (const EngineRun& engine : engines)
    if (ran_through(engine))
      contestants.push_back(bare_run(build(engine.name, bundle), bundle.model, options.stop));
  return time_engines(contestants, options.trials, [&options](int done, int planned) {
    show(options, "timing", static_cast<double>(done) / planned);
    return !stopped(options);
  });
}

}  // namespace

bool Member::failed() const {
  return std::any_of(engines.begin(), engines.end(),
                     [](const EngineRun& engine) { return engine.status == Status::kFailed; });
}

std::string Member::exceeded_reference() const {
  for (const ReferenceRun& run : references)
    for (const Deviation& deviation : run.deviations)
      if (deviation.pass() == false) return run.name;
  return {};
}

Verdict Member::verdict() const {
  if (!exceeded_reference().empty()) return Verdict::kDisagree;
  return comparison ? comparison->verdict : Verdict::kNotJudged;
}

Member refused_member(const std::string& reason) {
  Member member;
  for (const char* engine : {"bsm", "mujoco"}) {
    EngineRun run;
    run.name = engine;
    run.status = Status::kSkipped;
    run.reason = reason;
    member.engines.push_back(std::move(run));
  }
  member.refused = true;
  return member;
}

Member run_member(const Bundle& bundle, const RunOptions& options) {
  Member member;
  for (const char* engine : {"bsm", "mujoco"})
    member.engines.push_back(run_engine(engine, bundle, options));
  const EngineRun& bsm = member.engines[0];
  const EngineRun& mujoco = member.engines[1];
  if (!bsm.trajectory.samples.empty() && !mujoco.trajectory.samples.empty())
    member.comparison = compare(bundle.model, bsm.trajectory, mujoco.trajectory);
  member.references = hold_against_references(bundle.model, member.engines);
  const bool runs_complete = !stopped(options) && !member.failed();
  if (options.trials > 0 && runs_complete)
    member.timing = time_member(bundle, member.engines, options);
  member.complete = runs_complete && (!member.timing || member.timing->complete());
  return member;
}

}  // namespace twincraft
