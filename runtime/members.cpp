// See members.h. Tested by tests/agreement/study_test.cpp.
#include "runtime/members.h"

#include "runtime/study/in_order.h"

namespace twincraft {

ReportedMember run_one(MemberSpec spec, const RunOptions& options) {
  if (!spec.bundle) return {{}, {}, refused_member(spec.refusal)};
  Bundle& bundle = *spec.bundle;
  const std::string refusal = reference_refusal(bundle.model, options);
  Member result = refusal.empty() ? run_member(bundle, options) : refused_member(refusal);
  std::vector<Setting> settings = bundle.settings;
  return {std::move(bundle), std::move(settings), std::move(result)};
}

std::vector<ReportedMember> run_study(const StudyRun& study, const RunOptions& options) {
  RunOptions quiet = options;
  quiet.progress = nullptr;  // of members, not inside them
  std::vector<ReportedMember> members;
  OrderedWork<ReportedMember> plan;
  plan.count = study.plan.members;
  plan.work = [&](std::size_t index) { return run_one(study.compile(index), quiet); };
  plan.deliver = [&](ReportedMember member) {
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
