// See trends.h. Members are put in groups that differ in one path alone; a trend is read off each
// group. Tested by tests/runtime/sweep_test.cpp.
#include "runtime/study/trends.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace twincraft {
namespace {

using Points = std::vector<StudyPoint>;

/// Members that differ in `path` and nothing else (zipped: whose paths all step together).
struct Group {
  std::string path;
  std::vector<Setting> others;
  Points points;
};

bool same_values(const std::vector<Setting>& a, const std::vector<Setting>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Setting& x, const Setting& y) { return x.text == y.text; });
}

std::vector<Setting> others_of(const StudyPlan& plan, const std::string& path,
                               const StudyPoint& point) {
  std::vector<Setting> others;
  if (!plan.is_grid) return others;
  for (const std::string& other : plan.paths)
    if (other != path) others.push_back(*find_setting(*point.settings, other));
  return others;
}

std::vector<Group> groups_along(const std::string& path, const StudyPlan& plan,
                                const Points& points) {
  std::vector<Group> groups;
  for (const StudyPoint& point : points) {
    if (find_setting(*point.settings, path) == nullptr) continue;  // it never got that far
    std::vector<Setting> others = others_of(plan, path, point);
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
      return same_values(group.others, others);
    });
    Group& group = found != groups.end() ? *found : groups.emplace_back();
    group.path = path;
    group.others = std::move(others);
    group.points.push_back(point);
  }
  return groups;
}

bool is_step(const std::string& path) { return path.starts_with("simulation.step"); }

using Number = std::function<std::optional<double>(const StudyPoint&)>;

double exponent(double x1, double x2, double y1, double y2) {
  const bool exists = x1 > 0.0 && x2 > 0.0 && x1 != x2 && y1 > 0.0 && y2 > 0.0;
  const double value = std::log(y2 / y1) / std::log(x2 / x1);
  return exists && std::isfinite(value) ? value : std::nan("");
}

/// Nothing when there is no exponent to tell.
void add_trend(const Group& group, Trend trend, const Number& x, const Number& y,
               std::vector<Trend>& trends) {
  trend.path = group.path;
  trend.others = group.others;
  for (const StudyPoint& point : group.points) {
    const std::optional<double> at = x(point), value = y(point);
    if (!at || !value) continue;
    trend.x.push_back(*at);
    trend.y.push_back(*value);
    trend.members.push_back(point.member);
  }
  bool any = false;
  for (std::size_t i = 1; i < trend.x.size(); ++i) {
    trend.exponents.push_back(exponent(trend.x[i - 1], trend.x[i], trend.y[i - 1], trend.y[i]));
    any = any || !std::isnan(trend.exponents.back());
  }
  if (any) trends.push_back(std::move(trend));
}

std::optional<double> metric_of(const StudyPoint& point, const std::string& key) {
  if (!point.result->comparison) return std::nullopt;
  for (const Metric& metric : point.result->comparison->metrics)
    if (metric.key == key) return metric.maximum;
  return std::nullopt;
}

/// Every metric that the first member with a comparison has.
void add_metrics(const Group& group, const Number& x, std::vector<Trend>& trends) {
  const auto compared =
      std::find_if(group.points.begin(), group.points.end(),
                   [](const StudyPoint& point) { return point.result->comparison.has_value(); });
  if (compared == group.points.end()) return;
  for (const Metric& metric : compared->result->comparison->metrics) {
    Trend trend;
    trend.metric = metric.key;
    add_trend(
        group, trend, x, [&](const StudyPoint& point) { return metric_of(point, metric.key); },
        trends);
  }
}

std::optional<double> deviation_of(const StudyPoint& point, const ReferenceRun& like,
                                   const std::string& metric) {
  for (const ReferenceRun& run : point.result->references) {
    if (run.name != like.name || run.engine != like.engine) continue;
    for (const Deviation& deviation : run.deviations)
      if (deviation.metric == metric) return deviation.max;
  }
  return std::nullopt;
}

void add_references(const Group& group, const Number& x, std::vector<Trend>& trends) {
  for (const ReferenceRun& run : group.points.front().result->references)
    for (const Deviation& deviation : run.deviations) {
      Trend trend;
      trend.reference = run.name;
      trend.engine = run.engine;
      trend.metric = deviation.metric;
      add_trend(
          group, trend, x,
          [&](const StudyPoint& point) { return deviation_of(point, run, deviation.metric); },
          trends);
    }
}

std::optional<double> microseconds_per_step(const StudyPoint& point, const std::string& engine) {
  if (!point.result->timing || !point.result->timing->complete()) return std::nullopt;
  for (const EngineTiming& timing : point.result->timing->engines)
    if (timing.name == engine) return 1.0e6 * timing.per_step();
  return std::nullopt;
}

}  // namespace

const Setting* find_setting(const std::vector<Setting>& settings, const std::string& path) {
  const auto found = std::find_if(settings.rbegin(), settings.rend(),
                                  [&path](const Setting& one) { return one.path == path; });
  return found == settings.rend() ? nullptr : &*found;
}

std::vector<Trend> convergence_of(const StudyPlan& plan, const std::vector<StudyPoint>& points) {
  std::vector<Trend> trends;
  const Number step = [](const StudyPoint& point) { return point.step; };
  for (const std::string& path : plan.paths) {
    if (!is_step(path)) continue;
    for (const Group& group : groups_along(path, plan, points)) {
      if (group.points.front().result->references.empty())
        add_metrics(group, step, trends);
      else
        add_references(group, step, trends);
    }
  }
  return trends;
}

std::vector<Trend> scaling_of(const StudyPlan& plan, const std::vector<StudyPoint>& points) {
  std::vector<Trend> trends;
  const Number size = [](const StudyPoint& point) { return point.degrees_of_freedom; };
  for (const std::string& path : plan.paths) {
    if (!plan.is_grid && path != plan.paths.front()) break;  // all paths make one group
    for (const Group& group : groups_along(path, plan, points))
      for (const char* engine : {"bsm", "mujoco"}) {
        Trend trend;
        trend.engine = engine;
        add_trend(
            group, trend, size,
            [engine](const StudyPoint& point) { return microseconds_per_step(point, engine); },
            trends);
      }
  }
  return trends;
}

std::vector<Trend> slopes_of(const StudyPlan& plan, const std::vector<StudyPoint>& points) {
  std::vector<Trend> trends;
  for (const std::string& path : plan.paths) {
    if (is_step(path)) continue;
    const Number value = [&path](const StudyPoint& point) {
      return find_setting(*point.settings, path)->value;
    };
    for (const Group& group : groups_along(path, plan, points)) add_metrics(group, value, trends);
  }
  return trends;
}

}  // namespace twincraft
