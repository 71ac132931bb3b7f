// Figures are listed once, with what they show and the metric that judges them.
// Tested by tests/runtime/html_test.cpp.
#include "runtime/report/html/histories.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "runtime/report/html/base64.h"
#include "runtime/report/html/decimate.h"
#include "runtime/report/words.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;
using Kind = Coordinate::Kind;

constexpr double kDegrees = 180.0 / std::numbers::pi;  // [deg/rad]

// What a page can hold: a screen has some 2000 columns of dots, and 300 000 numbers are 3.2 MB.
constexpr std::size_t kMostPoints = 3000;
constexpr std::size_t kMostNumbers = 300'000;
constexpr std::size_t kLeastPoints = 200;

struct Series {
  std::string name;
  std::function<double(const Observation&)> value;
};

struct Figure {
  std::string title, unit, metric;  // metric: empty when nothing judges it
  std::vector<Series> series;
};

Figure vector_figure(const char* title, const char* unit, const char* metric,
                     Vector3d Observation::*vector) {
  Figure figure{title, unit, metric, {}};
  for (int i = 0; i < 3; ++i)
    figure.series.push_back(
        {std::string(1, "xyz"[i]), [vector, i](const Observation& o) { return (o.*vector)[i]; }});
  return figure;
}

Figure attitude_figure() {
  Figure figure{"Attitude, quaternion from hub to inertial axes", "1", "attitude_deg", {}};
  figure.series.push_back({"w", [](const Observation& o) { return o.q_BN.w(); }});
  for (int i = 0; i < 3; ++i)
    figure.series.push_back(
        {std::string(1, "xyz"[i]), [i](const Observation& o) { return o.q_BN.vec()[i]; }});
  return figure;
}

/// Positions or rates of the joints of some kinds.
Figure joint_figure(const Model& model, Figure figure, std::vector<double> Observation::*values,
                    double scale, std::initializer_list<Kind> kinds) {
  for (const Coordinate& coordinate : model.coordinates) {
    if (std::find(kinds.begin(), kinds.end(), coordinate.kind) == kinds.end()) continue;
    const auto joint = static_cast<std::size_t>(coordinate.index - 1);
    figure.series.push_back({coordinate.name, [values, joint, scale](const Observation& o) {
                               return scale * (o.*values)[joint];
                             }});
  }
  return figure;
}

Figure wheel_figure(const Model& model) {
  Figure figure{"Wheel rates", "rad/s", "wheel_rate_rad_s", {}};
  for (const Coordinate& coordinate : model.coordinates) {
    if (coordinate.kind != Kind::kWheel) continue;
    const auto wheel = static_cast<std::size_t>(coordinate.index);
    figure.series.push_back(
        {coordinate.name, [wheel](const Observation& o) { return o.wheel_rate[wheel]; }});
  }
  return figure;
}

std::vector<Figure> coordinate_figures(const Model& model) {
  const auto position = &Observation::joint_position;
  const auto rate = &Observation::joint_rate;
  const std::initializer_list<Kind> angles = {Kind::kPanel, Kind::kBodyAngle};
  return {
      joint_figure(model, {"Panel and joint angles", "deg", "joint_deg", {}}, position, kDegrees,
                   angles),
      joint_figure(model, {"Joint travel", "m", "joint_m", {}}, position, 1.0,
                   {Kind::kBodyDisplacement}),
      wheel_figure(model),
      joint_figure(model, {"Slosh displacements", "m", "slosh_m", {}}, position, 1.0,
                   {Kind::kParticle}),
      joint_figure(model, {"Pendulum angles", "deg", "pendulum_deg", {}}, position, kDegrees,
                   {Kind::kPendulum}),
      joint_figure(model, {"Panel and joint rates", "deg/s", "", {}}, rate, kDegrees, angles),
      joint_figure(model, {"Joint speeds", "m/s", "", {}}, rate, 1.0,
                   {Kind::kBodyDisplacement, Kind::kParticle}),
      joint_figure(model, {"Pendulum rates", "deg/s", "", {}}, rate, kDegrees, {Kind::kPendulum}),
  };
}

bool is_constant(const Model& model) {
  return std::all_of(model.tanks.begin(), model.tanks.end(),
                     [](const Tank& tank) { return tank.mass_flow.is_zero(); });
}

std::vector<Figure> figures_of(const Model& model) {
  std::vector<Figure> figures;
  if (!model.simulation.translation) {
    figures.push_back(attitude_figure());
    figures.push_back(
        vector_figure("Body rate, hub axes", "rad/s", "rate_rad_s", &Observation::omega_BN_B));
  }
  for (Figure& figure : coordinate_figures(model))
    if (!figure.series.empty()) figures.push_back(std::move(figure));
  figures.push_back(
      vector_figure("Hub position, inertial axes", "m", "position_m", &Observation::r_BN_N));
  figures.push_back(
      vector_figure("Hub velocity, inertial axes", "m/s", "velocity_m_s", &Observation::v_BN_N));
  figures.push_back(vector_figure("System centre of mass, inertial axes", "m", "com_position_m",
                                  &Observation::r_CN_N));
  if (!is_constant(model))
    figures.push_back(
        {"Mass", "kg", "mass_kg", {{"mass", [](const Observation& o) { return o.mass; }}}});
  return figures;
}

class HistoryPrinter {
 public:
  explicit HistoryPrinter(const ReportedMember& member);
  Json print() const;

 private:
  const Trajectory& trajectory(std::size_t engine) const {
    return member_.result.engines[engine].trajectory;
  }
  Json times() const;
  Json figure_json(const Figure& figure) const;
  Json difference_json(const Figure& figure) const;
  Json metric_json(const std::string& key) const;
  Json plain_differences(const Figure& figure) const;
  Json conservation_figure() const;

  const ReportedMember& member_;
  std::vector<Figure> figures_;
  MetricCurves curves_;
  std::vector<Decimation> decimations_;  // bsm, mujoco, what both have
};

/// How many points each column may have.
std::size_t points_for(const std::vector<Figure>& figures) {
  std::size_t columns = 10;  // times and conservation
  for (const Figure& figure : figures) columns += 3 * figure.series.size();
  return std::clamp(kMostNumbers / columns, kLeastPoints, kMostPoints);
}

HistoryPrinter::HistoryPrinter(const ReportedMember& member)
    : member_(member),
      figures_(figures_of(member.bundle.model)),
      curves_(metric_curves(member.bundle.model, trajectory(0), trajectory(1))) {
  const std::size_t points = points_for(figures_);
  for (std::size_t engine : {0U, 1U})
    decimations_.emplace_back(trajectory(engine).samples.size(), points);
  decimations_.emplace_back(curves_.samples, points);
}

Json HistoryPrinter::times() const {
  Json times = Json::object();
  const auto add = [&](const std::string& name, std::size_t which, const Trajectory& source) {
    if (decimations_[which].points() == 0) return;
    times[name] = base64(
        decimations_[which].instants([&source](std::size_t i) { return source.samples[i].time; }));
  };
  for (std::size_t engine : {0U, 1U})
    add(member_.result.engines[engine].name, engine, trajectory(engine));
  add("difference", 2, trajectory(0));
  return times;
}

/// The very metric of the agreement table.
Json HistoryPrinter::metric_json(const std::string& key) const {
  const auto has_key = [&key](const auto& one) { return one.key == key; };
  const auto curve = std::find_if(curves_.curves.begin(), curves_.curves.end(), has_key);
  const auto [label, unit] = words_of(key, member_.bundle.model);
  Json json{{"unit", unit}, {"metric", key}, {"tolerance", nullptr}};
  if (member_.result.comparison) {
    const std::vector<Metric>& metrics = member_.result.comparison->metrics;
    const auto metric = std::find_if(metrics.begin(), metrics.end(), has_key);
    if (metric != metrics.end() && metric->tolerance) json["tolerance"] = *metric->tolerance;
  }
  json["series"] = {{{"name", label}, {"values", base64(decimations_[2].extremes(curve->at))}}};
  return json;
}

/// Where no metric exists: component by component.
Json HistoryPrinter::plain_differences(const Figure& figure) const {
  Json json{{"unit", figure.unit}, {"tolerance", nullptr}, {"series", Json::array()}};
  for (const Series& series : figure.series) {
    const Column column = [&](std::size_t i) {
      return std::abs(series.value(trajectory(0).samples[i]) -
                      series.value(trajectory(1).samples[i]));
    };
    json["series"].push_back(
        {{"name", series.name}, {"values", base64(decimations_[2].extremes(column))}});
  }
  return json;
}

Json HistoryPrinter::difference_json(const Figure& figure) const {
  if (curves_.samples == 0) return nullptr;
  return figure.metric.empty() ? plain_differences(figure) : metric_json(figure.metric);
}

Json HistoryPrinter::figure_json(const Figure& figure) const {
  Json json{{"title", figure.title}, {"unit", figure.unit}, {"series", Json::array()}};
  for (const Series& series : figure.series) {
    Json one{{"name", series.name}};
    for (std::size_t engine : {0U, 1U}) {
      const std::vector<Observation>& samples = trajectory(engine).samples;
      if (samples.empty()) continue;
      one[member_.result.engines[engine].name] = base64(
          decimations_[engine].extremes([&](std::size_t i) { return series.value(samples[i]); }));
    }
    json["series"].push_back(std::move(one));
  }
  json["difference"] = difference_json(figure);
  return json;
}

Json HistoryPrinter::conservation_figure() const {
  Json json{{"title", "Imbalance of the conservation books"},
            {"unit", "1"},
            {"logarithmic", true},
            {"series", Json::array()}};
  const auto add = [&](const char* name, double Conservation::*balance) {
    Json one{{"name", name}};
    for (std::size_t engine : {0U, 1U}) {
      if (trajectory(engine).samples.empty()) continue;
      const ConservationCurve curve(trajectory(engine));
      one[member_.result.engines[engine].name] = base64(
          decimations_[engine].extremes([&](std::size_t i) { return curve.at(i).*balance; }));
    }
    json["series"].push_back(std::move(one));
  };
  add("energy", &Conservation::energy);
  add("momentum", &Conservation::momentum);
  add("angular momentum", &Conservation::angular_momentum);
  return json;
}

Json HistoryPrinter::print() const {
  const auto thins = [](const Decimation& one) { return one.thins(); };
  const auto by_points = [](const Decimation& a, const Decimation& b) {
    return a.points() < b.points();
  };
  Json json{
      {"samples", std::max(trajectory(0).samples.size(), trajectory(1).samples.size())},
      {"points", std::max_element(decimations_.begin(), decimations_.end(), by_points)->points()},
      {"thinned", std::any_of(decimations_.begin(), decimations_.end(), thins)},
      {"times", times()},
      {"figures", Json::array()}};
  for (const Figure& figure : figures_) json["figures"].push_back(figure_json(figure));
  json["figures"].push_back(conservation_figure());
  return json;
}

}  // namespace

Json histories_json(const ReportedMember& member) { return HistoryPrinter(member).print(); }

}  // namespace twincraft
