// See report.h. Tested by tests/runtime/report_test.cpp.
#include "runtime/report/report.h"

#include <algorithm>

namespace twincraft {

void ReportedMember::shed() {
  bundle.mjcf.clear();
  bundle.assembly_json.clear();
  bundle.resolved_yaml.clear();
  bundle.model.tree = {};
  for (EngineRun& run : result.engines) {
    std::vector<Observation>& samples = run.trajectory.samples;
    if (!samples.empty()) samples = {samples.back()};
    run.trajectory.books = {};
  }
}

bool Report::complete() const {
  if (study && members.size() < study->members) return false;
  if (attribution && !attribution->complete) return false;
  return std::all_of(members.begin(), members.end(),
                     [](const ReportedMember& member) { return member.result.complete; });
}

Verdict Report::verdict() const {
  const auto is = [](Verdict verdict) {
    return [verdict](const ReportedMember& member) { return member.result.verdict() == verdict; };
  };
  if (std::any_of(members.begin(), members.end(), is(Verdict::kDisagree)))
    return Verdict::kDisagree;
  const bool all_agree = std::all_of(members.begin(), members.end(), is(Verdict::kAgree));
  return all_agree ? Verdict::kAgree : Verdict::kNotJudged;
}

std::vector<StudyPoint> study_points(const std::vector<ReportedMember>& members) {
  std::vector<StudyPoint> points;
  for (const ReportedMember& member : members) {
    const Model& model = member.bundle.model;
    points.push_back(
        {&member.settings, model.simulation.step, model.degrees_of_freedom(), &member.result});
  }
  return points;
}

StudyResults study_results(const Report& report) {
  if (!report.study) return {};
  const StudyPlan& plan = *report.study;
  const std::vector<StudyPoint> points = study_points(report.members);
  if (!plan.is_work_precision)
    return {convergence_of(plan, points), scaling_of(plan, points), slopes_of(plan, points), {}};
  StudyResults results;
  if (points.size() == plan.members) results.work_precision = work_precision_of(points);
  return results;
}

}  // namespace twincraft
