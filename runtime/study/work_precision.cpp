// See work_precision.h. Tested by tests/runtime/sweep_test.cpp.
#include "runtime/study/work_precision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "compiler/ir/angle.h"

namespace twincraft {
namespace {

/// Null when the engine did not get to the end of the member's run.
const EngineEnd* end_of(const StudyPoint& point, std::string_view engine) {
  for (const EngineEnd& end : point.ends)
    if (end.engine == engine) return &end;
  return nullptr;
}

FinalError difference(const EngineEnd& a, const EngineEnd& b) {
  return {kDegrees * principal_angle(a.q_BN, b.q_BN), (a.r_BN_N - b.r_BN_N).norm()};
}

WorkPoint point_of(const StudyPoint& member, std::size_t index, const EngineEnd& truth) {
  WorkPoint point;
  point.member = index;
  const EngineEnd* end = end_of(member, truth.engine);
  point.diverged = end == nullptr;
  if (point.diverged) return point;
  point.error = difference(*end, truth);
  point.evaluations = end->evaluations;
  point.median = end->median;
  point.diverged = !std::isfinite(point.error.attitude) || !std::isfinite(point.error.position);
  return point;
}

/// By time when all were timed, else by evaluations.
void mark_frontier(std::vector<WorkPoint>& points) {
  std::vector<WorkPoint*> order;
  for (WorkPoint& point : points)
    if (!point.diverged) order.push_back(&point);
  const bool timed = std::all_of(order.begin(), order.end(),
                                 [](const WorkPoint* point) { return point->median.has_value(); });
  const auto cost = [timed](const WorkPoint& point) {
    return timed ? *point.median : static_cast<double>(point.evaluations);
  };
  std::sort(order.begin(), order.end(), [&](const WorkPoint* a, const WorkPoint* b) {
    return std::tuple(cost(*a), a->error.attitude) < std::tuple(cost(*b), b->error.attitude);
  });
  double best = std::numeric_limits<double>::infinity();
  for (WorkPoint* point : order) {
    point->on_frontier = point->error.attitude < best;
    best = std::min(best, point->error.attitude);
  }
}

std::string integrator_of(const StudyPoint& member) {
  const Setting* setting = find_setting(member.settings, "simulation.integrator");
  return setting == nullptr ? std::string() : setting->text;
}

bool varies_tolerance(const StudyPoint& member) {
  return !member.settings.empty() &&
         member.settings.back().path.starts_with("simulation.tolerance");
}

}  // namespace

std::vector<EngineWork> work_precision_of(const StudyPoints& points) {
  std::vector<EngineWork> engines;
  const std::vector<StudyPoint>& members = points.all();
  const std::size_t configurations = members.size() - 2;
  for (const EngineName& engine : kEngines) {
    const std::string name(engine.key);
    const EngineEnd* truth = end_of(members[configurations], name);
    const EngineEnd* doubt = end_of(members[configurations + 1], name);
    if (truth == nullptr || doubt == nullptr) continue;
    EngineWork work{name, difference(*doubt, *truth), {}};
    for (std::size_t i = 0; i < configurations; ++i)
      work.points.push_back(point_of(members[i], i, *truth));
    mark_frontier(work.points);
    engines.push_back(std::move(work));
  }
  return engines;
}

std::vector<std::string> idle_tolerances(const EngineWork& work, const StudyPoints& points) {
  std::map<std::string, std::map<long, int>> runs;  // by integrator: how many took so many
  for (const WorkPoint& point : work.points) {
    const StudyPoint& member = points.all()[point.member];
    if (!point.diverged && varies_tolerance(member))
      ++runs[integrator_of(member)][point.evaluations];
  }
  std::vector<std::string> sentences;
  for (const auto& [integrator, counts] : runs) {
    int all = 0, alike = 0;
    for (const auto& [evaluations, count] : counts) {
      all += count;
      alike = std::max(alike, count);
    }
    if (alike > 1)
      sentences.push_back(
          fmt::format("{} of {} tolerances of {} take the same steps: they land at every `step`, "
                      "which is too short to tell them apart",
                      alike, all, integrator));
  }
  return sentences;
}

Faster compare_cost(const EngineWork& first, const EngineWork& second) {
  Faster faster;
  for (std::size_t i = 0; i < first.points.size(); ++i) {
    const WorkPoint& a = first.points[i];
    const WorkPoint& b = second.points[i];
    if (a.diverged || b.diverged || !a.median || !b.median) continue;
    ++faster.of;
    if (*a.median < *b.median) ++faster.first;
  }
  return faster;
}

}  // namespace twincraft
