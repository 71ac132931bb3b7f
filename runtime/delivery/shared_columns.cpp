#include "runtime/delivery/shared_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "compiler/diag/diagnostics.h"
#include "compiler/units/unit_system.h"
#include "compiler/units/units.h"

namespace twincraft {
namespace {

constexpr std::string_view kPosition = ".position", kRate = ".rate";

using Columns = std::vector<TrajectoryColumn>;
using Places = std::map<std::string_view, std::size_t>;

/// Named columns but `t`.
Places places_of(const Columns& columns) {
  Places places;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (!columns[i].name.empty() && columns[i].name != "t") places.emplace(columns[i].name, i);
  return places;
}

/// Of a unit as a file has it; `1` and `-` are those of a number.
Quantity factor_of(const std::string& unit, SiUnit si) {
  const bool is_number = unit == "1" || unit == "-";
  if (is_number && si == "1") return {1.0, {}, {}};
  return unit_factor(unit, si);
}

bool is_in(const std::optional<std::string>& unit, SiUnit si) {
  return unit && factor_of(*unit, si).error.empty();
}

bool is_pendulum(std::string_view name) {
  return name.ends_with(".phi") || name.ends_with(".theta");
}

/// The coordinates that two files name, where no spec says them.
class NamedCoordinates {
 public:
  NamedCoordinates(const Columns& a, const Columns& b) {
    for (const Columns* columns : {&a, &b})
      for (const TrajectoryColumn& column : *columns)
        if (column.name.ends_with(kPosition)) add_joint(column);
    for (const Columns* columns : {&a, &b})
      for (const TrajectoryColumn& column : *columns)
        if (column.name.ends_with(kRate)) add_wheel(column);
  }

  std::vector<Coordinate> take() && { return std::move(coordinates_); }

 private:
  using Kind = Coordinate::Kind;

  void add_joint(const TrajectoryColumn& column) {
    const std::string name = column.name.substr(0, column.name.size() - kPosition.size());
    if (!seen_.emplace(name, 0).second) return;
    if (is_in(column.unit, kTravel.unit))
      coordinates_.push_back({name, Kind::kBodyDisplacement, ++joints_});
    // One without a unit, too: it is refused where both files have it.
    else if (!column.unit || is_in(column.unit, kAngle.unit))
      coordinates_.push_back(
          {name, is_pendulum(name) ? Kind::kPendulum : Kind::kBodyAngle, ++joints_});
  }

  void add_wheel(const TrajectoryColumn& column) {
    const std::string name = column.name.substr(0, column.name.size() - kRate.size());
    if (!seen_.emplace(name, 0).second) return;
    if (!column.unit || is_in(column.unit, kSpin.rate_unit))
      coordinates_.push_back({name, Kind::kWheel, wheels_++});
  }

  std::vector<Coordinate> coordinates_;
  std::map<std::string, int> seen_;
  int joints_ = 0, wheels_ = 0;
};

Model model_of(const Columns& a, const Columns& b) {
  Model model;
  model.coordinates = NamedCoordinates(a, b).take();
  return model;
}

/// Empty without a unit that fits: then there is a fault.
std::optional<double> known_factor(const TrajectoryReader& file, std::size_t column, SiUnit si,
                                   std::vector<FileFault>& faults) {
  const TrajectoryColumn& of = file.columns()[column];
  if (!of.unit) {
    faults.push_back(file.fault_at(column, fmt::format("{} has no unit", in_backticks(of.name)),
                                   fmt::format("write `{} [{}]`", printable(of.name), si)));
    return std::nullopt;
  }
  const Quantity factor = factor_of(*of.unit, si);
  if (factor.error.empty()) return factor.value;
  faults.push_back(file.fault_at(
      column, fmt::format("the unit of {}: {}", in_backticks(of.name), factor.error), factor.hint));
  return std::nullopt;
}

/// In the unit of `a`; nothing when the two can not be compared.
std::optional<SharedColumn> share_unknown(const TrajectoryColumn& a, const TrajectoryColumn& b) {
  if (!a.unit || !b.unit) return std::nullopt;
  SharedColumn shared{a.name, *a.unit == "-" ? "1" : *a.unit};
  if (shared.unit != "1" && !find_unit(shared.unit).error.empty()) return std::nullopt;
  const Quantity factor = factor_of(*b.unit, shared.unit);
  if (!factor.error.empty()) return std::nullopt;
  shared.factor_b = factor.value;
  return shared;
}

/// Sorts columns into what is measured, what is compared one by one, and the rest.
class Sharing {
 public:
  Sharing(const TrajectoryReader& a, const TrajectoryReader& b, const Model& model,
          std::vector<FileFault>& faults)
      : a_(a), b_(b), outputs_(outputs_of(model)), faults_(faults) {
    shared_.model = model;
    for (std::size_t i = 0; i < outputs_.size(); ++i)
      for (std::size_t j = 0; j < outputs_[i].size(); ++j)
        known_.emplace(outputs_[i].component(j), std::pair(i, j));
  }

  SharedColumns run() && {
    const Places in_a = places_of(a_.columns()), in_b = places_of(b_.columns());
    for (std::size_t i = 0; i < a_.columns().size(); ++i) {
      const std::string& name = a_.columns()[i].name;
      if (!in_a.contains(name)) continue;
      const auto partner = in_b.find(name);
      if (partner == in_b.end())
        shared_.only_a.push_back(name);
      else
        share(i, partner->second);
    }
    for (const TrajectoryColumn& column : b_.columns())
      if (in_b.contains(column.name) && !in_a.contains(column.name))
        shared_.only_b.push_back(column.name);
    settle();
    return std::move(shared_);
  }

 private:
  void share(std::size_t a, std::size_t b) {
    const std::string& name = a_.columns()[a].name;
    const auto known = known_.find(name);
    if (known != known_.end()) return share_known(a, b, known->second);
    std::optional<SharedColumn> column = share_unknown(a_.columns()[a], b_.columns()[b]);
    if (!column) return shared_.incomparable.push_back(name);
    column->a = a;
    column->b = b;
    shared_.others.push_back(*std::move(column));
  }

  void share_known(std::size_t a, std::size_t b, std::pair<std::size_t, std::size_t> number) {
    const OutputSignal& output = outputs_[number.first];
    const std::optional<double> factor_a = known_factor(a_, a, output.unit, faults_);
    const std::optional<double> factor_b = known_factor(b_, b, output.unit, faults_);
    if (!factor_a || !factor_b) return;
    known_columns_.push_back(
        {{a_.columns()[a].name, output.unit, a, b, *factor_a, *factor_b}, output, number.second});
    ++found_[number.first];
  }

  /// A metric is taken from whole outputs alone.
  void settle() {
    std::vector<OutputSignal> held;
    for (const auto& [output, found] : found_)
      if (found == outputs_[output].size()) held.push_back(outputs_[output]);
    shared_.laws = metric_laws(shared_.model, held);
    for (SharedColumns::Measured& each : known_columns_) {
      if (is_held(each.output) && is_measured(each.output))
        shared_.measured.push_back(std::move(each));
      else
        shared_.others.push_back(std::move(each.column));
    }
    std::ranges::sort(shared_.others, {}, &SharedColumn::a);
    for (const MetricLaw& law : metric_laws(shared_.model))
      if (law.tolerance &&
          std::ranges::find(shared_.laws, law.row, &MetricLaw::row) == shared_.laws.end())
        shared_.unjudged.emplace_back(law.row->key);
  }

  bool is_held(const OutputSignal& output) const {
    const std::size_t index = known_.at(output.component(0)).first;
    return found_.at(index) == output.size();
  }
  bool is_measured(const OutputSignal& output) const {
    return std::ranges::any_of(shared_.laws,
                               [&output](const MetricLaw& law) { return law.row->takes(output); });
  }

  const TrajectoryReader &a_, &b_;
  std::vector<OutputSignal> outputs_;
  std::map<std::string, std::pair<std::size_t, std::size_t>, std::less<>> known_;
  std::map<std::size_t, std::size_t> found_;  // numbers of an output that are in both
  std::vector<SharedColumns::Measured> known_columns_;
  std::vector<FileFault>& faults_;
  SharedColumns shared_;
};

}  // namespace

SharedColumns share_columns(const TrajectoryReader& a, const TrajectoryReader& b, const Model* spec,
                            std::vector<FileFault>& faults) {
  return Sharing(a, b, spec != nullptr ? *spec : model_of(a.columns(), b.columns()), faults).run();
}

}  // namespace twincraft
