// See words.h. Tested by tests/runtime/report_test.cpp.
#include "runtime/report/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "compiler/ir/number.h"
#include "runtime/compare/conservation.h"
#include "runtime/integrate/tableau.h"

namespace twincraft {
namespace {

using Kind = Coordinate::Kind;

bool has(const Model& model, Kind kind) {
  return std::any_of(model.coordinates.begin(), model.coordinates.end(),
                     [kind](const Coordinate& coordinate) { return coordinate.kind == kind; });
}

/// Components, not coordinates: `wing_p.1` and `wing_p.2` are one panel.
std::size_t count_components(const Model& model, std::string_view word) {
  std::set<std::string> names;
  for (const Coordinate& coordinate : model.coordinates)
    if (kind_of(coordinate).one == word)
      names.insert(coordinate.name.substr(0, coordinate.name.find('.')));
  return names.size();
}

std::string gravity_words(GravityLaw law) {
  switch (law) {
    case GravityLaw::kNone:
      return "no gravity";
    case GravityLaw::kSystemCom:
      return "gravity at the system CoM";
    case GravityLaw::kBodyCom:
      return "gravity at each body";
    case GravityLaw::kBodyGradient:
      break;
  }
  return "gravity and its gradient at each body";
}

}  // namespace

MetricWords words_of(std::string_view key, const Model& model) {
  if (key == "joint_deg" && !has(model, Kind::kBodyAngle)) return {"panel angle", "deg"};
  if (key == "delta_v_relative") return {"delta-v, relative", ""};
  if (const MetricRow* metric = find_metric_row(key))
    return {std::string(metric->label), std::string(metric->unit)};
  if (const BalanceRow* balance = find_balance(key)) return {std::string(balance->label), ""};
  return {std::string(key), ""};
}

std::string vehicle_words(const Model& model) {
  std::string text = fmt::format("{} DOF: {}", model.degrees_of_freedom(),
                                 model.simulation.translation ? "point mass" : "hub");
  std::string_view told;
  for (const CoordinateKind& kind : kCoordinateKinds) {
    if (kind.one == std::exchange(told, kind.one)) continue;
    const std::size_t count = count_components(model, kind.one);
    if (count > 0) text += fmt::format(", {} {}", count, count == 1 ? kind.one : kind.many);
  }
  return text;
}

std::string span_words(double seconds) {
  constexpr double kDay = 86400.0;           // [s]
  constexpr double kYear = 31556925.974678;  // [s] the year of UDUNITS, which specs are written in
  const auto in_unit = [seconds](double unit, std::string_view name) {
    return fmt::format("{:.4g} {}", seconds / unit, name);
  };
  if (seconds >= 2.0 * kYear) return in_unit(kYear, "years");
  return seconds >= 2.0 * kDay ? in_unit(kDay, "days") : shortest(seconds) + " s";
}

std::string plan_words(const Model& model) {
  const SimulationPlan& plan = model.simulation;
  const Tableau& tableau = tableau_of(plan.method);
  std::string text = fmt::format("{}, {} {} {}", span_words(plan.duration), tableau.name,
                                 tableau.adaptive ? "landing every" : "at", span_words(plan.step));
  text += ", " + gravity_words(model.gravity.bsm);
  if (model.gravity.mujoco != model.gravity.bsm)
    text += fmt::format(" (MuJoCo: {})", gravity_words(model.gravity.mujoco));
  return text;
}

std::string depletion_words(const Model& model) {
  const double end = model.simulation.duration;
  std::size_t draining = 0, jets = 0;
  for (const Tank& tank : model.tanks) {
    if (tank.content_at(end) == tank.content) continue;
    ++draining;
    if (tank.momentum == LeavingMomentum::kJet) ++jets;
  }
  if (draining == 0) return {};
  if (jets == 0) return "propellant leaves without angular momentum: no jet damping";
  if (jets == draining) return "propellant leaves with the nozzle's velocity: jet damping";
  return fmt::format("jet damping from {} of {} draining tanks", jets, draining);
}

std::string quantity(double value, std::string_view unit) {
  const std::string number = value == 0.0 ? "0" : fmt::format("{:.1e}", value);
  return unit.empty() ? number : fmt::format("{} {}", number, unit);
}

std::string duration(double seconds) {
  constexpr std::array<std::pair<double, std::string_view>, 3> kUnits{
      {{1.0e-9, "ns"}, {1.0e-6, "us"}, {1.0e-3, "ms"}}};
  for (const auto& [unit, name] : kUnits)
    if (seconds < 999.5 * unit) return fmt::format("{:.3g} {}", seconds / unit, name);
  return seconds < 999.5 ? fmt::format("{:.3g} s", seconds) : fmt::format("{:.0f} s", seconds);
}

}  // namespace twincraft
