// The order of a member's work; each part lives in its own file.
// Tested by tests/agreement/scsim_test.cpp.
#include "runtime/study/member.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/simulate/engines.h"
#include "runtime/study/twin_flight.h"

namespace twincraft {
namespace {

using Status = EngineRun::Status;

/// The worst of the engines that have samples; without an engine when none has.
Balance worst_of(const BalanceRow& row, const std::vector<EngineRun>& engines) {
  Balance worst{.key = std::string(row.key)};
  for (const EngineRun& engine : engines) {
    if (engine.trajectory.samples.empty()) continue;
    const double found = engine.conservation.*row.imbalance;
    const bool is_worse = found > worst.maximum || std::isnan(found);
    if (!worst.engine.empty() && (!is_worse || std::isnan(worst.maximum))) continue;
    worst.maximum = found;
    worst.engine = engine.name;
  }
  return worst;
}

std::vector<Balance> balances(const Agreement& tolerances, const std::vector<EngineRun>& engines) {
  std::vector<Balance> all;
  for (const BalanceRow& row : kBalances) {
    Balance worst = worst_of(row, engines);
    worst.tolerance = tolerances.*row.tolerance;
    if (!worst.engine.empty()) all.push_back(std::move(worst));
  }
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
      contestants.push_back(
          bare_run(make_engine(engine_of(engine.name), bundle, options.instructions.set),
                   bundle.model, options.stop));
  return time_engines(contestants, options.trials, [&options](int done, int planned) {
    options.show(fmt::format("timing trial {} of {}", std::min(done + 1, planned), planned),
                 static_cast<double>(done) / planned);
    return !options.stopped();
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

std::vector<JudgedFigure> Member::exceeded() const {
  std::vector<JudgedFigure> figures = judged();
  std::erase_if(figures, [](const JudgedFigure& figure) { return figure.held(); });
  return figures;
}

bool Member::judges_agreement() const {
  return std::ranges::any_of(
      judged(), [](JudgedFigure::Of of) { return of == JudgedFigure::Of::kAgreement; },
      &JudgedFigure::of);
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
  for (const EngineName& engine : kEngines) {
    EngineRun run;
    run.name = engine.key;
    run.status = Status::kSkipped;
    run.reason = reason;
    member.engines.push_back(std::move(run));
  }
  member.refused = true;
  return member;
}

Member run_member(const Bundle& bundle, const RunOptions& options, MemberWatch* watch) {
  Member member;
  member.judges_resolution = bundle.model.simulation.judges_resolution;
  fly_both(bundle, options, watch, member);
  member.conservation = balances(bundle.model.agreement, member.engines);
  const bool runs_complete = !options.stopped() && !member.failed();
  if (options.trials > 0 && runs_complete)
    member.timing = time_member(bundle, member.engines, options);
  member.complete = runs_complete && (!member.timing || member.timing->complete());
  return member;
}

}  // namespace twincraft
