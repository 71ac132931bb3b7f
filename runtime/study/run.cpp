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
          [engine, duration, &options](double time) { show(options, engine, time / duration); },
          {}};
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

EngineRun run_engine(std::string_view name, const Bundle& bundle, const Inspection& inspection,
                     const RunOptions& options) {
  EngineRun run;
  run.name = name;
  run.reason = skip_reason(name, bundle.model, options);
  if (!run.reason.empty()) {
    run.status = Status::kSkipped;
    return run;
  }
  try {
    const std::unique_ptr<Engine> engine = build(name, bundle);
    PropagateOptions watched_run = watched(name, bundle.model.simulation.duration, options);
    watched_run.instants = inspection.all();
    run.trajectory = propagate(*engine, bundle.model, watched_run);
    conclude(run);
  } catch (const NumericalFailure& failure) {  // it could not even be built or observed
    run.status = Status::kFailed;
    run.reason = failure.what();
  }
  return run;
}

MotionRecord record_of(const Model& model, const Inspection& inspection, const EngineRun& run) {
  MotionRecord record(model, inspection.events);
  const Trajectory& trajectory = run.trajectory;
  for (std::size_t i = 0; i < trajectory.samples.size(); ++i)
    record.see(trajectory.samples[i], trajectory.books[i]);
  return record;
}

RunShown shown(const EngineRun& run, const MotionRecord& record) {
  const Trajectory& trajectory = run.trajectory;
  const double steps = static_cast<double>(std::max(1L, trajectory.counts.accepted));
  return {&record, trajectory.instants, trajectory.t_end, trajectory.t_end / steps,
          trajectory.accepted};
}

/// Says of a run that stopped when it did, and what stopped it.
void explain(const Model& model, const Inspection& inspection, const MotionRecord& record,
             EngineRun& run, Member& member) {
  const Resolution why = explain_failure(model, inspection, shown(run, record));
  run.reason = fmt::format("stopped at t = {} s: {}", shortest(run.trajectory.t_end),
                           why.reasons.empty() ? run.reason : why.reasons.front());
  if (!member.resolution || member.resolution->reasons.empty()) member.resolution = why;
}

/// By the first engine that flew: both share motion, method and step.
void judge_resolution(const Model& model, const Inspection& inspection, Member& member) {
  std::vector<MotionRecord> records;
  for (EngineRun& run : member.engines) {
    records.push_back(record_of(model, inspection, run));
    run.own_energy = figures_of(records.back().energy());
  }
  std::vector<const OwnEnergy*> energies;
  for (std::size_t i = 0; i < records.size(); ++i) {
    EngineRun& run = member.engines[i];
    if (run.status == Status::kFailed) explain(model, inspection, records[i], run, member);
    if (run.status == Status::kOk) energies.push_back(&records[i].energy());
  }
  if (member.failed()) return;
  for (std::size_t i = 0; i < records.size() && !member.resolution; ++i)
    if (member.engines[i].status == Status::kOk)
      member.resolution = twincraft::judge_resolution(
          model, inspection, shown(member.engines[i], records[i]), energies);
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

bool Member::interrupted() const { return !complete && !refused && !failed(); }

bool Member::unresolved() const { return resolution && !resolution->resolved && judges_resolution; }

Verdict Member::verdict() const {
  if (failed()) return Verdict::kFailed;
  if (interrupted()) return Verdict::kInterrupted;
  if (unresolved()) return Verdict::kUnresolved;
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
  member.judges_resolution = bundle.model.simulation.judges_resolution;
  const Inspection inspection = plan_inspection(bundle.model);
  for (const char* engine : {"bsm", "mujoco"})
    member.engines.push_back(run_engine(engine, bundle, inspection, options));
  const EngineRun& bsm = member.engines[0];
  const EngineRun& mujoco = member.engines[1];
  judge_resolution(bundle.model, inspection, member);
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
