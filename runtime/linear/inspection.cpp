#include "runtime/linear/inspection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "compiler/ir/inputs.h"
#include "runtime/integrate/tableau.h"
#include "runtime/linear/linearise.h"

namespace twincraft {
namespace {

// After an event fast motion comes first: steps at which it is probed, then instants up to the
// next event.
constexpr std::array kFirstSteps{0.0, 2.0, 6.0, 14.0, 30.0};
constexpr int kLaterInstants = 10;

// Probes cost three steps each: one in fifty steps leaves the verdict far below the run's cost.
constexpr double kLeastProbes = 15.0;
constexpr double kStepsPerProbe = 50.0;
constexpr std::size_t kMostStretches = 12;

/// The events that shake the vehicle most, in the order of time.
std::vector<double> hardest(const Model& model, const std::vector<double>& events,
                            std::size_t count) {
  if (events.size() <= count) return events;
  OwnMotion motion(model);
  const Observation start{model.initial};
  std::vector<double> shakes;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const double before = i == 0 ? 0.0 : events[i - 1];
    shakes.push_back((motion.rates(start, events[i]) - motion.rates(start, before)).norm());
  }
  std::vector<std::size_t> order(events.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return shakes[i]; });
  std::vector<double> found;
  for (std::size_t i = 0; i < count; ++i) found.push_back(events[order[i]]);
  std::ranges::sort(found);
  return found;
}

void add_probes(const Stretch& stretch, double step, double budget, std::vector<double>& probes) {
  const auto first = static_cast<std::size_t>(std::clamp(budget / 3.0, 1.0, 5.0));
  for (std::size_t i = 0; i < first; ++i)
    if (const double at = stretch.begin + kFirstSteps[i] * step; at < stretch.end - 0.5 * step)
      probes.push_back(at);
  const double later = std::min<double>(kLaterInstants, budget - static_cast<double>(first));
  const double begin = stretch.begin + kFirstSteps[first - 1] * step;
  for (int i = 1; i <= later; ++i)
    if (const double at = begin + (stretch.end - begin) * i / (later + 1.0);
        at < stretch.end - 0.5 * step)
      probes.push_back(at);
}

void tidy(std::vector<double>& times, double step) {
  std::ranges::sort(times);
  const auto same = [step](double a, double b) { return b - a < 0.5 * step; };
  times.erase(std::unique(times.begin(), times.end(), same), times.end());
}

}  // namespace

bool drains(const Model& model) {
  return std::ranges::any_of(model.tanks, [&](const Tank& tank) {
    return tank.content_at(model.simulation.duration) != tank.content;
  });
}

std::vector<double> Inspection::all() const {
  std::vector<double> times = probes;
  times.insert(times.end(), before.begin(), before.end());
  times.insert(times.end(), along.begin(), along.end());
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

Inspection plan_inspection(const Model& model) {
  const double step = model.simulation.step;
  const double duration = model.simulation.duration;
  const double probes = std::max(kLeastProbes, duration / step / kStepsPerProbe);
  Inspection plan{input_events(model), {}, {}, {}, {}};
  const auto stretches = static_cast<std::size_t>(std::min(probes / 3.0, 1.0 * kMostStretches));
  std::vector<double> looked_at = hardest(model, plan.events, stretches - 1);
  looked_at.insert(looked_at.begin(), 0.0);
  const double budget = probes / static_cast<double>(looked_at.size());
  const bool is_draining = drains(model);
  for (const double begin : looked_at) {
    const auto next = std::ranges::upper_bound(plan.events, begin);
    plan.stretches.push_back({begin, next == plan.events.end() ? duration : *next});
    if (!tableau_of(model.simulation.method).adaptive)
      add_probes(plan.stretches.back(), step, budget, plan.probes);
    const double just_before = plan.stretches.back().end - step;
    if (is_draining && just_before > begin) plan.before.push_back(just_before);
  }
  for (const double part : {0.25, 0.5, 0.75}) plan.along.push_back(part * duration);
  tidy(plan.probes, step);
  tidy(plan.before, step);
  return plan;
}

}  // namespace twincraft
