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

bool is_about_resolution(const StudyPlan& study) {
  return study.is_work_precision || std::ranges::any_of(study.paths, [](const std::string& path) {
           return path.starts_with("simulation.step") ||
                  path.starts_with("simulation.integrator") ||
                  path.starts_with("simulation.tolerance");
         });
}

Verdict Report::verdict() const {
  const bool may_be_unresolved = study && is_about_resolution(*study);
  const bool may_fail = study && study->is_work_precision;
  for (const Verdict verdict : {Verdict::kInterrupted, Verdict::kFailed, Verdict::kUnresolved,
                                Verdict::kDisagree, Verdict::kNotJudged}) {
    if (verdict == Verdict::kUnresolved && may_be_unresolved) continue;
    if (verdict == Verdict::kFailed && may_fail) continue;
    if (std::ranges::any_of(members, [verdict](const ReportedMember& member) {
          return member.result.verdict() == verdict;
        }))
      return verdict;
  }
  if (study && members.size() < study->members) return Verdict::kInterrupted;
  return Verdict::kAgree;
}

std::vector<StudyPoint> study_points(const std::vector<ReportedMember>& members) {
  std::vector<StudyPoint> points;
  for (const ReportedMember& member : members) {
    const Model& model = member.bundle.model;
    points.push_back({&member.settings, model.simulation.step, model.degrees_of_freedom(),
                      &member.result, points.size()});
  }
  return points;
}

StudyResults study_results(const Report& report) {
  if (!report.study) return {};
  const StudyPlan& plan = *report.study;
  std::vector<StudyPoint> points = study_points(report.members);
  if (!plan.is_work_precision) {
    const std::size_t all = points.size();
    std::erase_if(points, [](const StudyPoint& point) {
      return point.result->failed() || point.result->unresolved();
    });
    return {convergence_of(plan, points),
            scaling_of(plan, points),
            slopes_of(plan, points),
            {},
            all - points.size()};
  }
  StudyResults results;
  if (points.size() == plan.members) results.work_precision = work_precision_of(points);
  return results;
}

}  // namespace twincraft
