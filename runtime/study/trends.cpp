// See trends.h. Members are put in groups that differ in one path alone; a trend is read off each
// group. Tested by tests/runtime/sweep_test.cpp.
#include "runtime/study/trends.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>

namespace twincraft {
namespace {

using Points = std::vector<const StudyPoint*>;

/// Members that differ in `path` and nothing else (zipped: whose paths all step together).
struct Group {
  std::string path;
  std::vector<Setting> others;
  Points points;
};

std::vector<Setting> others_of(const StudyPlan& plan, const std::string& path,
                               const StudyPoint& point) {
  std::vector<Setting> others;
  if (!plan.is_grid) return others;
  for (const std::string& other : plan.paths)
    if (other != path) others.push_back(*find_setting(point.settings, other));
  return others;
}

std::vector<Group> groups_along(const std::string& path, const StudyPlan& plan,
                                const StudyPoints& points) {
  std::vector<Group> groups;
  std::map<std::vector<std::string>, std::size_t> known;  // groups by the values of the others
  for (const StudyPoint& point : points.all()) {
    if (!point.in_fits || find_setting(point.settings, path) == nullptr) continue;
    std::vector<Setting> others = others_of(plan, path, point);
    std::vector<std::string> values;
    for (const Setting& other : others) values.push_back(other.text);
    const auto [found, is_new] = known.try_emplace(std::move(values), groups.size());
    if (is_new) groups.push_back({path, std::move(others), {}});
    groups[found->second].points.push_back(&point);
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

const Figure* find_figure(const StudyPoint& point, const StudyQuantity& quantity) {
  for (const Figure& figure : point.figures)
    if (*figure.quantity == quantity) return &figure;
  return nullptr;
}

double exponent_before(const Trend& trend, std::size_t i) {
  if (trend.is_rounding[i - 1] || trend.is_rounding[i]) return std::nan("");
  return exponent(trend.x[i - 1], trend.x[i], trend.y[i - 1], trend.y[i]);
}

/// Nothing when there is neither an exponent to tell nor rounding to name.
void add_trend(const Group& group, const StudyQuantity& quantity, const Number& x,
               std::vector<Trend>& trends) {
  Trend trend;
  trend.reference = quantity.reference;
  trend.engine = quantity.engine;
  trend.metric = quantity.metric;
  trend.path = group.path;
  trend.others = group.others;
  for (const StudyPoint* point : group.points) {
    const std::optional<double> at = x(*point);
    const Figure* figure = find_figure(*point, quantity);
    if (!at || figure == nullptr) continue;
    trend.x.push_back(*at);
    trend.y.push_back(figure->value);
    trend.is_rounding.push_back(figure->value > 0.0 && figure->value <= figure->rounding);
    trend.members.push_back(point->member);
  }
  for (std::size_t i = 1; i < trend.x.size(); ++i)
    trend.exponents.push_back(exponent_before(trend, i));
  const bool any_rounding = std::ranges::find(trend.is_rounding, true) != trend.is_rounding.end();
  if (trend.has_exponents() || (any_rounding && trend.x.size() > 1))
    trends.push_back(std::move(trend));
}

bool is_agreement(const StudyQuantity& quantity) {
  return quantity.reference.empty() && quantity.engine.empty();
}

/// Every metric that the first member with a comparison has.
void add_metrics(const Group& group, const Number& x, std::vector<Trend>& trends) {
  const auto is_metric = [](const Figure& figure) { return is_agreement(*figure.quantity); };
  const auto compared = std::ranges::find_if(group.points, [&](const StudyPoint* point) {
    return std::ranges::any_of(point->figures, is_metric);
  });
  if (compared == group.points.end()) return;
  for (const Figure& figure : (*compared)->figures)
    if (is_metric(figure)) add_trend(group, *figure.quantity, x, trends);
}

bool has_references(const Group& group) {
  return std::ranges::any_of(group.points.front()->figures, [](const Figure& figure) {
    return !figure.quantity->reference.empty();
  });
}

/// Every deviation that the first member has.
void add_references(const Group& group, const Number& x, std::vector<Trend>& trends) {
  for (const Figure& figure : group.points.front()->figures)
    if (!figure.quantity->reference.empty()) add_trend(group, *figure.quantity, x, trends);
}

/// What rounding leaves in a quantity of this size: half a unit in the last place at every step,
/// this way and that, so that it grows with the root of the steps; eight times that, as a bound.
double rounding_of(double size, long steps) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  return 4.0 * kEpsilon * std::sqrt(static_cast<double>(steps)) * size;
}

/// Of a metric that the engines were compared in; 0 when they were not.
double size_of(std::string_view key, const Member& member) {
  if (member.comparison)
    for (const Metric& metric : member.comparison->metrics)
      if (metric.key == key) return metric.size;
  return 0.0;
}

long steps_of(const Member& member) {
  long steps = 0;
  for (const EngineRun& run : member.engines)
    steps = std::max(steps, run.trajectory.counts.accepted);
  return steps;
}

std::vector<EngineEnd> ends_of(const Member& member) {
  std::vector<EngineEnd> ends;
  for (const EngineRun& run : member.engines) {
    if (run.status != EngineRun::Status::kOk || run.trajectory.samples.empty() ||
        run.trajectory.status != Trajectory::Status::kComplete)
      continue;
    const Observation& last = run.trajectory.samples.back();
    ends.push_back({run.name, last.q_BN, last.r_BN_N, run.trajectory.counts.evaluations, {}});
    if (!member.timing || !member.timing->complete()) continue;
    for (const EngineTiming& timing : member.timing->engines)
      if (timing.name == run.name) ends.back().median = timing.median();
  }
  return ends;
}

}  // namespace

const Setting* find_setting(const std::vector<Setting>& settings, const std::string& path) {
  const auto found = std::find_if(settings.rbegin(), settings.rend(),
                                  [&path](const Setting& one) { return one.path == path; });
  return found == settings.rend() ? nullptr : &*found;
}

bool Trend::has_exponents() const {
  return std::ranges::any_of(exponents, [](double value) { return !std::isnan(value); });
}

void StudyPoints::add_figure(StudyQuantity quantity, double value, double rounding,
                             StudyPoint& point) {
  point.figures.push_back({&*quantities_.insert(std::move(quantity)).first, value, rounding});
}

void StudyPoints::add(const std::vector<Setting>& settings, const Model& model,
                      const Member& member, bool keep_ends) {
  StudyPoint point;
  point.settings = settings;
  point.step = model.simulation.step;
  point.degrees_of_freedom = model.degrees_of_freedom();
  point.member = all_.size();
  point.in_fits = !member.failed() && !member.unresolved();
  const long steps = steps_of(member);
  if (member.comparison)
    for (const Metric& metric : member.comparison->metrics)
      add_figure({"", "", metric.key}, metric.maximum, rounding_of(metric.size, steps), point);
  for (const ReferenceRun& run : member.references)
    for (const Deviation& deviation : run.deviations)
      add_figure({run.name, run.engine, deviation.metric}, deviation.max,
                 rounding_of(size_of(deviation.metric, member), steps), point);
  if (member.timing && member.timing->complete())
    for (const EngineTiming& timing : member.timing->engines)
      add_figure({"", timing.name, ""}, 1.0e6 * timing.per_step(), 0.0, point);
  if (keep_ends) point.ends = ends_of(member);
  point.figures.shrink_to_fit();
  all_.push_back(std::move(point));
}

std::vector<Trend> convergence_of(const StudyPlan& plan, const StudyPoints& points) {
  std::vector<Trend> trends;
  const Number step = [](const StudyPoint& point) { return point.step; };
  for (const std::string& path : plan.paths) {
    if (!is_step(path)) continue;
    for (const Group& group : groups_along(path, plan, points)) {
      if (has_references(group))
        add_references(group, step, trends);
      else
        add_metrics(group, step, trends);
    }
  }
  return trends;
}

std::vector<Trend> scaling_of(const StudyPlan& plan, const StudyPoints& points) {
  std::vector<Trend> trends;
  const Number size = [](const StudyPoint& point) { return point.degrees_of_freedom; };
  for (const std::string& path : plan.paths) {
    if (!plan.is_grid && path != plan.paths.front()) break;  // all paths make one group
    for (const Group& group : groups_along(path, plan, points))
      for (const EngineName& engine : kEngines)
        add_trend(group, {"", std::string(engine.key), ""}, size, trends);
  }
  return trends;
}

std::vector<Trend> slopes_of(const StudyPlan& plan, const StudyPoints& points) {
  std::vector<Trend> trends;
  for (const std::string& path : plan.paths) {
    if (is_step(path)) continue;
    const Number value = [&path](const StudyPoint& point) {
      return find_setting(point.settings, path)->value;
    };
    for (const Group& group : groups_along(path, plan, points)) add_metrics(group, value, trends);
  }
  return trends;
}

}  // namespace twincraft
