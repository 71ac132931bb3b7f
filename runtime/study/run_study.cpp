// See run_study.h. Tested by tests/agreement/study_test.cpp.
#include "runtime/study/run_study.h"

#include <map>

#include "runtime/study/in_order.h"

namespace twincraft {
namespace {

/// Holds members against their baselines, of which it keeps those that are still needed.
class Comparer {
 public:
  explicit Comparer(const StudyPlan& plan) : plan_(plan) {}

  /// @pre called for one member after another, in their order
  void see(std::size_t index, ReportedMember& member) {
    if (!plan_.compare) return;
    const std::size_t baseline = plan_.baseline_of(index);
    if (baseline == index)
      kept_[index] = member.result.engines;
    else
      member.against = held_against(baseline, member);
    if (plan_.last_held_against(baseline) == index) kept_.erase(baseline);
  }

 private:
  Baseline held_against(std::size_t baseline, const ReportedMember& member) const {
    Baseline against{baseline, {}};
    for (const EngineRun& run : member.result.engines)
      for (const EngineRun& first : kept_.at(baseline)) {
        if (first.name != run.name) continue;
        if (first.status == EngineRun::Status::kFailed) against.failed.push_back(first.name);
        if (first.status == EngineRun::Status::kFailed || run.status == EngineRun::Status::kFailed)
          continue;  // what there is of a run that failed is no trajectory to be held against
        Comparison comparison = compare_hubs(member.bundle.model.simulation.translation,
                                             first.trajectory, run.trajectory);
        if (!comparison.metrics.empty())
          against.engines.push_back({run.name, std::move(comparison)});
      }
    return against;
  }

  const StudyPlan& plan_;
  std::map<std::size_t, std::vector<EngineRun>> kept_;
};

}  // namespace

FlownMember run_one(MemberSpec spec, const RunOptions& options, const MakeOutput& make_output) {
  if (!spec.bundle) return {{{}, {}, refused_member(spec.refusal)}, nullptr};
  Bundle& bundle = *spec.bundle;
  std::unique_ptr<MemberOutput> output = make_output ? make_output(bundle) : nullptr;
  Member result = run_member(bundle, options, output.get());
  options.show("write", 0.0);
  if (output) output->land();
  std::vector<Setting> settings = bundle.settings;
  return {{std::move(bundle), std::move(settings), std::move(result)}, std::move(output)};
}

void run_study(const StudyRun& study, const RunOptions& options) {
  RunOptions quiet = options;
  quiet.progress = nullptr;  // of members, not inside them
  std::size_t done = 0;
  OrderedWork<FlownMember> plan;
  plan.count = study.plan.members;
  plan.work = [&](std::size_t index) {
    return run_one(study.compile(index), quiet,
                   [&](const Bundle& bundle) { return study.output(index, bundle); });
  };
  Comparer comparer(study.plan);
  plan.deliver = [&](FlownMember flown) {
    ReportedMember& member = flown.member;
    comparer.see(done, member);
    if (flown.output) flown.output->publish(member);
    study.finished(done++, std::move(member));
    options.show("members", static_cast<double>(done) / static_cast<double>(plan.count));
  };
  plan.may_go_on = [&options] { return !options.stopped(); };
  in_order(plan, options.trials > 0 ? 1 : study.jobs);
}

}  // namespace twincraft
