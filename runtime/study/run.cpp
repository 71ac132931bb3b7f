// The order of a member's work; each part lives in its own file.
// Tested by tests/agreement/scsim_test.cpp.
#include "runtime/study/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "compiler/ir/number.h"
#include "runtime/bsm/engine.h"
#include "runtime/mujoco/engine.h"
#include "runtime/study/resolve.h"

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

/// One engine on its way.
class EngineFlight {
 public:
  EngineFlight(std::string_view name, const Bundle& bundle, const Inspection& inspection,
               const RunOptions& options, std::function<void()> progress)
      : model_(bundle.model) {
    run_.name = name;
    run_.reason = skip_reason(name, bundle.model, options);
    if (!run_.reason.empty()) {
      run_.status = Status::kSkipped;
      return;
    }
    guarded([&] {
      engine_ = build(name, bundle);
      flight_ = std::make_unique<RecordedRun>(
          *engine_, model_, store_,
          PropagateOptions{options.stop, [this, progress = std::move(progress)](double time) {
                             time_ = time;
                             progress();
                           },
                           inspection.all()});
    });
  }

  EngineFlight(const EngineFlight&) = delete;
  EngineFlight& operator=(const EngineFlight&) = delete;

  bool flies() const { return flight_ != nullptr; }
  bool ended() const { return !flies() || flight_->ended(); }
  double time() const { return time_; }
  void advance_until(double time) {
    if (!ended()) guarded([&] { flight_->advance_until(time); });
  }

  EngineRun conclude() {
    if (flies()) guarded([this] { conclude_flight(); });
    return std::move(run_);
  }

 private:
  /// An engine may not even be built.
  template <class Work>
  void guarded(const Work& work) {
    try {
      work();
    } catch (const NumericalFailure& failure) {
      run_.status = Status::kFailed;
      run_.reason = failure.what();
    }
  }

  void conclude_flight() {
    Trajectory& trajectory = run_.trajectory = flight_->take_trajectory();
    trajectory.samples = std::move(store_.samples);
    trajectory.books = std::move(store_.books);
    run_.conservation = conservation_of(trajectory);
    if (trajectory.status == Trajectory::Status::kFailed) {
      run_.status = Status::kFailed;
      run_.reason = trajectory.failure;
    } else if (trajectory.status == Trajectory::Status::kInterrupted) {
      run_.reason = fmt::format("interrupted at t = {} s", shortest(trajectory.t_end));
    }
  }

  const Model& model_;
  EngineRun run_;
  SampleStore store_;
  std::unique_ptr<Engine> engine_;
  std::unique_ptr<RecordedRun> flight_;
  double time_ = 0.0;  // last heard of
};

/// How far both engines go before the next slice: as far as they come in about 50 ms, so that they
/// stay together, an early end leaves a stretch to compare, and changing over costs nothing. How a
/// run is cut changes nothing in it.
class Slices {
 public:
  explicit Slices(const SimulationPlan& plan)
      : step_(plan.step), longest_(kMostSamples * plan.record) {}

  double next() {
    const Clock::time_point now = Clock::now();
    if (now - begin_ < std::chrono::milliseconds(25)) steps_ *= 2.0;
    if (now - begin_ > std::chrono::milliseconds(100)) steps_ = std::max(1.0, steps_ / 2.0);
    begin_ = now;
    return time_ += std::min(steps_ * step_, longest_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr double kMostSamples = 1000.0;
  double step_, longest_;  // [s]
  double steps_ = 0.5;
  double time_ = 0.0;  // [s] where the slice ends
  Clock::time_point begin_ = Clock::now();
};

/// Both engines side by side, as far as they are flown.
class TwinFlight {
 public:
  TwinFlight(const Bundle& bundle, const Inspection& inspection, const RunOptions& options)
      : plan_(bundle.model.simulation),
        options_(options),
        bsm_("bsm", bundle, inspection, options, [this] { show_progress(); }),
        mujoco_("mujoco", bundle, inspection, options, [this] { show_progress(); }) {}

  std::vector<EngineRun> fly() {
    Slices slices(plan_);
    while (!bsm_.ended() || !mujoco_.ended()) {
      const double until = slices.next();
      bsm_.advance_until(until);
      mujoco_.advance_until(until);
    }
    return {bsm_.conclude(), mujoco_.conclude()};
  }

 private:
  void show_progress() const {
    const bool both = bsm_.flies() && mujoco_.flies();
    const double done = (bsm_.time() + mujoco_.time()) / plan_.duration;
    if (both)
      show(options_, "both", 0.5 * done);
    else
      show(options_, bsm_.flies() ? "bsm" : "mujoco", done);
  }

  const SimulationPlan& plan_;
  const RunOptions& options_;
  EngineFlight bsm_, mujoco_;
};

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

/// The worst of the engines that have samples, balance by balance.
std::vector<Balance> balances(const Agreement& tolerances, const std::vector<EngineRun>& engines) {
  std::vector<Balance> all;
  const auto add = [&](const char* key, double Conservation::*imbalance,
                       std::optional<double> tolerance) {
    Balance worst{.key = key, .tolerance = tolerance};
    for (const EngineRun& engine : engines) {
      if (engine.trajectory.samples.empty()) continue;
      const double found = engine.conservation.*imbalance;
      const bool is_worse = found > worst.maximum || std::isnan(found);
      if (!worst.engine.empty() && (!is_worse || std::isnan(worst.maximum))) continue;
      worst.maximum = found;
      worst.engine = engine.name;
    }
    if (!worst.engine.empty()) all.push_back(worst);
  };
  add("energy_relative", &Conservation::energy, tolerances.energy);
  add("momentum_relative", &Conservation::momentum, tolerances.momentum);
  add("angular_momentum_relative", &Conservation::angular_momentum, tolerances.angular_momentum);
  return all;
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
    show(options, fmt::format("timing trial {} of {}", std::min(done + 1, planned), planned),
         static_cast<double>(done) / planned);
    return !stopped(options);
  });
}

}  // namespace

bool Member::failed() const {
  return std::any_of(engines.begin(), engines.end(),
                     [](const EngineRun& engine) { return engine.status == Status::kFailed; });
}

std::vector<JudgedFigure> Member::judged() const {
  using Of = JudgedFigure::Of;
  std::vector<JudgedFigure> figures;
  if (comparison)
    for (const Metric& metric : comparison->metrics)
      if (metric.tolerance)
        figures.push_back({Of::kAgreement, metric.key, "", "", metric.maximum, *metric.tolerance});
  for (const Balance& balance : conservation)
    if (balance.tolerance)
      figures.push_back({Of::kConservation, balance.key, balance.engine, "", balance.maximum,
                         *balance.tolerance});
  for (const ReferenceRun& run : references)
    for (const Deviation& deviation : run.deviations)
      if (deviation.tolerance)
        figures.push_back({Of::kReference, deviation.metric, run.engine, run.name, deviation.max,
                           *deviation.tolerance});
  return figures;
}

bool Member::interrupted() const { return !complete && !refused && !failed(); }

bool Member::unresolved() const { return resolution && !resolution->resolved && judges_resolution; }

Verdict Member::verdict() const {
  if (failed()) return Verdict::kFailed;
  if (interrupted()) return Verdict::kInterrupted;
  if (unresolved()) return Verdict::kUnresolved;
  return judge(judged(), complete && (!comparison || comparison->same_times));
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
  member.engines = TwinFlight(bundle, inspection, options).fly();
  const EngineRun& bsm = member.engines[0];
  const EngineRun& mujoco = member.engines[1];
  judge_member(bundle.model, inspection, member);
  if (!bsm.trajectory.samples.empty() && !mujoco.trajectory.samples.empty())
    member.comparison = compare(bundle.model, bsm.trajectory, mujoco.trajectory);
  member.conservation = balances(bundle.model.agreement, member.engines);
  member.references = hold_against_references(bundle.model, member.engines);
  const bool runs_complete = !stopped(options) && !member.failed();
  if (options.trials > 0 && runs_complete)
    member.timing = time_member(bundle, member.engines, options);
  member.complete = runs_complete && (!member.timing || member.timing->complete());
  return member;
}

}  // namespace twincraft
