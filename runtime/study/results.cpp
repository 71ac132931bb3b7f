// See results.h. Tested by tests/runtime/report_test.cpp.
#include "runtime/study/results.h"

#include <algorithm>

namespace twincraft {

void ReportedMember::shed() {
  for (auto& [target, emitted] : bundle.emitted) emitted.text = std::string();
  bundle.resolved_json = std::string();
  bundle.model.tree = {};
  for (EngineRun& run : result.engines) {
    std::vector<Observation>& samples = run.trajectory.samples;
    if (!samples.empty()) samples = std::vector<Observation>{samples.back()};
    run.trajectory.books = std::vector<Books>();
  }
}

void StudyRecord::add(const ReportedMember& member) {
  for (const OutputValue& output : member.outputs)
    breaks_requirements_ = breaks_requirements_ || !output.holds;
  const Member& result = member.result;
  if (result.complete) ++complete_;
  ++verdicts_[result.verdict()];
  if (exceeded_.empty()) exceeded_ = result.exceeded();
  is_judged_ = is_judged_ || !result.judged().empty();
  judges_agreement_ = judges_agreement_ && result.judges_agreement();
  points_.add(member.settings, member.bundle.model, result, keep_ends_);
}

std::size_t StudyRecord::count(Verdict verdict) const {
  const auto found = verdicts_.find(verdict);
  return found == verdicts_.end() ? 0 : found->second;
}

std::shared_ptr<const StudyRecord> Report::summary() const {
  if (record) return record;
  auto made = std::make_shared<StudyRecord>(true);
  for (const ReportedMember& member : members) made->add(member);
  return made;
}

bool Report::complete() const {
  const std::shared_ptr<const StudyRecord> all = summary();
  if (study && all->members() < study->members) return false;
  if (attribution && !attribution->complete) return false;
  return all->complete() == all->members();
}

bool is_about_resolution(const StudyPlan& study) {
  return study.is_work_precision || std::ranges::any_of(study.paths, [](const std::string& path) {
           return path.starts_with("simulation.step") ||
                  path.starts_with("simulation.integrator") ||
                  path.starts_with("simulation.tolerance");
         });
}

Verdict Report::verdict() const {
  const std::shared_ptr<const StudyRecord> all = summary();
  const bool may_be_unresolved = study && is_about_resolution(*study);
  const bool may_fail = study && study->is_work_precision;
  for (const Verdict verdict : {Verdict::kInterrupted, Verdict::kFailed, Verdict::kUnresolved,
                                Verdict::kDisagree, Verdict::kNotJudged}) {
    if (verdict == Verdict::kUnresolved && may_be_unresolved) continue;
    if (verdict == Verdict::kFailed && may_fail) continue;
    if (all->count(verdict) > 0) return verdict;
  }
  if (study && all->members() < study->members) return Verdict::kInterrupted;
  return Verdict::kAgree;
}

StudyPoints study_points(const std::vector<ReportedMember>& members) {
  StudyPoints points;
  for (const ReportedMember& member : members)
    points.add(member.settings, member.bundle.model, member.result, true);
  return points;
}

StudyResults study_results(const Report& report) {
  if (!report.study) return {};
  const StudyPlan& plan = *report.study;
  const std::shared_ptr<const StudyRecord> all = report.summary();
  const StudyPoints& points = all->points();
  if (!plan.is_work_precision) {
    const auto left_out = std::ranges::count(points.all(), false, &StudyPoint::in_fits);
    return {convergence_of(plan, points),
            scaling_of(plan, points),
            slopes_of(plan, points),
            {},
            static_cast<std::size_t>(left_out)};
  }
  StudyResults results;
  if (points.all().size() == plan.members) results.work_precision = work_precision_of(points);
  return results;
}

}  // namespace twincraft
