// See work_precision.h. Tested by tests/runtime/sweep_test.cpp.
#include "runtime/study/work_precision.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

namespace twincraft {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;  // [deg/rad]

/// The run of an engine that got to its end; null when there is none.
const EngineRun* completed(const Member& member, std::string_view engine) {
  for (const EngineRun& run : member.engines)
    if (run.name == engine && run.status == EngineRun::Status::kOk &&
        run.trajectory.status == Trajectory::Status::kComplete && !run.trajectory.samples.empty())
      return &run;
  return nullptr;
}

FinalError difference(const EngineRun& run, const EngineRun& truth) {
  const Observation& a = run.trajectory.samples.back();
  const Observation& b = truth.trajectory.samples.back();
  return {kDegrees * principal_angle(a.q_BN, b.q_BN), (a.r_BN_N - b.r_BN_N).norm()};
}

std::optional<double> median_of(const Member& member, std::string_view engine) {
  if (!member.timing || !member.timing->complete()) return std::nullopt;
  for (const EngineTiming& timing : member.timing->engines)
    if (timing.name == engine) return timing.median();
  return std::nullopt;
}

WorkPoint point_of(const Member& member, std::size_t index, const EngineRun& truth) {
  WorkPoint point;
  point.member = index;
  const EngineRun* run = completed(member, truth.name);
  point.diverged = run == nullptr;
  if (point.diverged) return point;
  point.error = difference(*run, truth);
  point.evaluations = run->trajectory.counts.evaluations;
  point.median = median_of(member, truth.name);
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

}  // namespace

std::vector<EngineWork> work_precision_of(const std::vector<StudyPoint>& points) {
  std::vector<EngineWork> engines;
  const std::size_t configurations = points.size() - 2;
  const Member& reference = *points[configurations].result;
  const Member& check = *points[configurations + 1].result;
  for (const char* name : {"bsm", "mujoco"}) {
    const EngineRun* truth = completed(reference, name);
    const EngineRun* doubt = completed(check, name);
    if (truth == nullptr || doubt == nullptr) continue;
    EngineWork work{name, difference(*doubt, *truth), {}};
    for (std::size_t i = 0; i < configurations; ++i)
      work.points.push_back(point_of(*points[i].result, i, *truth));
    mark_frontier(work.points);
    engines.push_back(std::move(work));
  }
  return engines;
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
