// See members.h. Tested by tests/agreement/study_test.cpp.
#include "runtime/members.h"

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

ReportedMember run_one(MemberSpec spec, const RunOptions& options) {
  if (!spec.bundle) return {{}, {}, refused_member(spec.refusal), {}};
  Bundle& bundle = *spec.bundle;
  Member result = run_member(bundle, options);
  std::vector<Setting> settings = bundle.settings;
  return {std::move(bundle), std::move(settings), std::move(result), {}};
}

std::vector<ReportedMember> run_study(const StudyRun& study, const RunOptions& options) {
  RunOptions quiet = options;
  quiet.progress = nullptr;  // of members, not inside them
  std::vector<ReportedMember> members;
  OrderedWork<ReportedMember> plan;
  plan.count = study.plan.members;
  plan.work = [&](std::size_t index) { return run_one(study.compile(index), quiet); };
  Comparer comparer(study.plan);
  plan.deliver = [&](ReportedMember member) {
    comparer.see(members.size(), member);
    study.finished(members.size(), member);
    if (!members.empty()) member.shed();
    members.push_back(std::move(member));
    if (options.progress)
      options.progress(
          "members", static_cast<double>(members.size()) / static_cast<double>(study.plan.members));
  };
  plan.may_go_on = [&options] { return options.stop == nullptr || !*options.stop; };
  in_order(plan, options.trials > 0 ? 1 : study.jobs);
  return members;
}

}  // namespace twincraft
