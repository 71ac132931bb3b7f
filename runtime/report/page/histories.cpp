// Figures are listed once, with what they show and the metric that judges them.
// Tested by tests/runtime/html_test.cpp.
#include "runtime/report/page/histories.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compiler/ir/angle.h"
#include "runtime/report/page/base64.h"
#include "runtime/report/page/decimate.h"
#include "runtime/report/words.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

// What a page can hold: a screen has some 2000 columns of dots, and 300 000 numbers are 3.2 MB.
constexpr std::size_t kMostPoints = 3000;
constexpr std::size_t kMostNumbers = 300'000;
constexpr std::size_t kLeastPoints = 200;

using Series = Histories::Series;
using Figure = Histories::Figure;

/// What a figure shows: one vector, or the coordinates that some metrics compare.
struct FigureRow {
  const char *title, *unit, *metric;  // no metric: nothing judges it
  OutputSignal::Of of;
  std::vector<std::string_view> groups = {};  // metrics of the coordinates that belong here
};

/// In the order of the page.
const std::vector<FigureRow>& figure_rows() {
  using Of = OutputSignal::Of;
  static const std::vector<FigureRow> rows{
      {"Attitude, quaternion from hub to inertial axes", "1", "attitude_deg", Of::kAttitude},
      {"Body rate, hub axes", "rad/s", "rate_rad_s", Of::kHubRate},
      {"Panel and joint angles", "deg", "joint_deg", Of::kCoordinate, {"joint_deg"}},
      {"Joint travel", "m", "joint_m", Of::kCoordinate, {"joint_m"}},
      {"Wheel rates", "rad/s", "wheel_rate_rad_s", Of::kCoordinateRate, {"wheel_rate_rad_s"}},
      {"Slosh displacements", "m", "slosh_m", Of::kCoordinate, {"slosh_m"}},
      {"Pendulum angles", "deg", "pendulum_deg", Of::kCoordinate, {"pendulum_deg"}},
      {"Panel and joint rates", "deg/s", "", Of::kCoordinateRate, {"joint_deg"}},
      {"Joint speeds", "m/s", "", Of::kCoordinateRate, {"joint_m", "slosh_m"}},
      {"Pendulum rates", "deg/s", "", Of::kCoordinateRate, {"pendulum_deg"}},
      {"Hub position, inertial axes", "m", "position_m", Of::kHubPosition},
      {"Hub velocity, inertial axes", "m/s", "velocity_m_s", Of::kHubVelocity},
      {"System centre of mass, inertial axes", "m", "com_position_m", Of::kComPosition},
      {"Mass", "kg", "mass_kg", Of::kMass},
  };
  return rows;
}

bool is_constant(const Model& model) {
  return std::all_of(model.tanks.begin(), model.tanks.end(),
                     [](const Tank& tank) { return tank.mass_flow.is_zero(); });
}

/// A point mass does not turn, and a mass that stays is no history.
bool is_worth_showing(const OutputSignal& output, const Model& model) {
  const bool turns =
      output.of == OutputSignal::Of::kAttitude || output.of == OutputSignal::Of::kHubRate;
  if (turns) return !model.simulation.translation;
  return output.of != OutputSignal::Of::kMass || !is_constant(model);
}

bool belongs(const OutputSignal& output, const FigureRow& row) {
  if (output.of != row.of) return false;
  return !output.coordinate ||
         std::ranges::count(row.groups, kind_of(*output.coordinate).metric) > 0;
}

/// Beside its figure's title a component needs no more than its axis.
std::string short_name(const OutputSignal& output, std::size_t component) {
  if (output.coordinate) return output.coordinate->name;
  return output.axes.empty() ? output.name : std::string(1, output.axes[component]);
}

Figure figure_of(const FigureRow& row, const std::vector<OutputSignal>& outputs) {
  Figure figure{row.title, row.unit, row.metric, {}};
  const double scale = figure.unit.starts_with("deg") ? kDegrees : 1.0;
  for (const OutputSignal& output : outputs) {
    if (!belongs(output, row)) continue;
    for (std::size_t i = 0; i < output.size(); ++i)
      figure.series.push_back({short_name(output, i), [output, i, scale](const Observation& o) {
                                 return scale * value_of(output, i, o);
                               }});
  }
  return figure;
}

std::vector<Figure> figures_of(const Model& model) {
  std::vector<OutputSignal> outputs = outputs_of(model);
  std::erase_if(outputs,
                [&model](const OutputSignal& output) { return !is_worth_showing(output, model); });
  std::vector<Figure> figures;
  for (const FigureRow& row : figure_rows()) {
    Figure figure = figure_of(row, outputs);
    if (!figure.series.empty()) figures.push_back(std::move(figure));
  }
  return figures;
}

std::vector<std::string> keys_of(const Model& model) {
  std::vector<std::string> keys;
  for (const MetricLaw& law : metric_laws(model)) keys.emplace_back(law.row->key);
  return keys;
}

std::size_t count_series(const std::vector<Figure>& figures) {
  std::size_t count = 0;
  for (const Figure& figure : figures) count += figure.series.size();
  return count;
}

std::size_t count_unjudged(const std::vector<Figure>& figures) {
  std::size_t count = 0;
  for (const Figure& figure : figures)
    if (figure.metric.empty()) count += figure.series.size();
  return count;
}

/// How many points each column may have.
std::size_t points_for(const std::vector<Figure>& figures) {
  const std::size_t columns = 10 + 3 * count_series(figures);  // 10: times and conservation
  return std::clamp(kMostNumbers / columns, kLeastPoints, kMostPoints);
}

/// The figures as JSON, once all samples are there.
class HistoryPrinter {
 public:
  HistoryPrinter(const Model& model, const Member& member, const std::vector<Figure>& figures,
                 const std::vector<std::string>& metrics, const std::array<Decimator, 2>& engines,
                 const Decimator& pairs)
      : model_(model),
        member_(member),
        figures_(figures),
        metrics_(metrics),
        engines_(engines),
        pairs_(pairs),
        next_unjudged_(metrics.size()) {}

  Json times() const;
  /// Figures one after another: the columns of each follow those of the one before.
  Json figures();
  Json conservation(const std::array<ConservationMeter, 2>& books) const;

 private:
  const std::string& name(std::size_t engine) const { return member_.engines[engine].name; }
  Json figure_json(const Figure& figure);
  Json difference_json(const Figure& figure);
  Json metric_json(const std::string& key) const;
  Json plain_differences(const Figure& figure);

  const Model& model_;
  const Member& member_;
  const std::vector<Figure>& figures_;
  const std::vector<std::string>& metrics_;
  const std::array<Decimator, 2>& engines_;
  const Decimator& pairs_;
  std::size_t next_series_ = 0, next_unjudged_;  // columns
};

Json HistoryPrinter::times() const {
  Json times = Json::object();
  for (std::size_t engine : {0U, 1U})
    if (engines_[engine].samples() > 0) times[name(engine)] = base64(engines_[engine].times());
  if (pairs_.samples() > 0) times["difference"] = base64(pairs_.times());
  return times;
}

/// The very metric of the agreement table.
Json HistoryPrinter::metric_json(const std::string& key) const {
  const auto column = std::find(metrics_.begin(), metrics_.end(), key) - metrics_.begin();
  const auto [label, unit] = words_of(key, model_);
  Json json{{"unit", unit}, {"metric", key}, {"tolerance", nullptr}};
  if (member_.comparison)
    for (const Metric& metric : member_.comparison->metrics)
      if (metric.key == key && metric.tolerance) json["tolerance"] = *metric.tolerance;
  json["series"] = {
      {{"name", label}, {"values", base64(pairs_.extremes(static_cast<std::size_t>(column)))}}};
  return json;
}

/// Where no metric exists: component by component.
Json HistoryPrinter::plain_differences(const Figure& figure) {
  Json json{{"unit", figure.unit}, {"tolerance", nullptr}, {"series", Json::array()}};
  for (const Series& series : figure.series)
    json["series"].push_back(
        {{"name", series.name}, {"values", base64(pairs_.extremes(next_unjudged_++))}});
  return json;
}

Json HistoryPrinter::difference_json(const Figure& figure) {
  if (pairs_.samples() == 0) return nullptr;
  return figure.metric.empty() ? plain_differences(figure) : metric_json(figure.metric);
}

Json HistoryPrinter::figure_json(const Figure& figure) {
  Json json{{"title", figure.title}, {"unit", figure.unit}, {"series", Json::array()}};
  for (const Series& series : figure.series) {
    Json one{{"name", series.name}};
    for (std::size_t engine : {0U, 1U})
      if (engines_[engine].samples() > 0)
        one[name(engine)] = base64(engines_[engine].extremes(next_series_));
    json["series"].push_back(std::move(one));
    ++next_series_;
  }
  json["difference"] = difference_json(figure);
  return json;
}

Json HistoryPrinter::figures() {
  Json json = Json::array();
  for (const Figure& figure : figures_) json.push_back(figure_json(figure));
  return json;
}

Json HistoryPrinter::conservation(const std::array<ConservationMeter, 2>& books) const {
  Json json{{"title", "Imbalance of the conservation books"},
            {"unit", "1"},
            {"logarithmic", true},
            {"series", Json::array()}};
  std::size_t column = count_series(figures_);
  for (const BalanceRow& balance : kBalances) {
    Json one{{"name", balance.quantity}};
    for (std::size_t engine : {0U, 1U}) {
      if (engines_[engine].samples() == 0) continue;
      std::vector<double> values = engines_[engine].extremes(column);
      const double scale = books[engine].scales().*balance.imbalance;
      for (double& value : values) value = ConservationMeter::relative(value, scale);
      one[name(engine)] = base64(values);
    }
    json["series"].push_back(std::move(one));
    ++column;
  }
  return json;
}

}  // namespace

Histories::Histories(const Model& model)
    : figures_(figures_of(model)),
      metrics_(keys_of(model)),
      engines_{Decimator(count_series(figures_) + kBalances.size(), points_for(figures_)),
               Decimator(count_series(figures_) + kBalances.size(), points_for(figures_))},
      pairs_(metrics_.size() + count_unjudged(figures_), points_for(figures_)) {}

void Histories::take(std::size_t engine, const Observation& sample, const Books& books) {
  std::vector<double>& row = row_.at(engine);
  row.clear();
  for (const Figure& figure : figures_)
    for (const Series& series : figure.series) row.push_back(series.value(sample));
  ConservationMeter& meter = books_.at(engine);
  meter.take(sample, books);
  for (const BalanceRow& balance : kBalances) row.push_back(meter.imbalance().*balance.imbalance);
  engines_.at(engine).take(sample.time, row);
}

void Histories::take_pair(const Observation& bsm, const Observation& mujoco,
                          std::span<const double> metrics) {
  std::vector<double>& row = row_[2];
  row.assign(metrics.begin(), metrics.end());
  for (const Figure& figure : figures_) {
    if (!figure.metric.empty()) continue;
    for (const Series& series : figure.series)
      row.push_back(std::abs(series.value(bsm) - series.value(mujoco)));
  }
  pairs_.take(bsm.time, row);
}

Json Histories::json(const Model& model, const Member& member) const {
  HistoryPrinter printer(model, member, figures_, metrics_, engines_, pairs_);
  const std::array<const Decimator*, 3> all{&engines_[0], &engines_[1], &pairs_};
  std::size_t points = 0;
  bool thinned = false;
  for (const Decimator* one : all) {
    points = std::max(points, one->points());
    thinned = thinned || one->thins();
  }
  Json json{{"samples", std::max(engines_[0].samples(), engines_[1].samples())},
            {"points", points},
            {"thinned", thinned},
            {"times", printer.times()},
            {"figures", printer.figures()}};
  json["figures"].push_back(printer.conservation(books_));
  return json;
}

}  // namespace twincraft
