// The clock and the order of trials. Tested by tests/runtime/timing_test.cpp.
#include "runtime/simulate/timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "runtime/simulate/propagate.h"

namespace twincraft {
namespace {

void run_trial(const TimedEngine& engine, const Stopwatch& stopwatch, EngineTiming& timing) {
  const double begin = stopwatch();  // [s]
  const std::size_t steps = engine.run();
  const double elapsed = stopwatch() - begin;  // [s]
  if (steps == 0) return;
  timing.steps = steps;
  timing.trials.push_back(elapsed);
}

}  // namespace

double monotonic_seconds() {
  // Counted from the first call: a difference of small numbers keeps its nanoseconds.
  static const auto first = std::chrono::steady_clock::now();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - first).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double EngineTiming::median() const { return twincraft::median(trials); }

double EngineTiming::per_step() const {
  return steps == 0 ? 0.0 : median() / static_cast<double>(steps);
}

double EngineTiming::spread() const {
  const double middle = median();
  std::vector<double> distances;
  for (const double trial : trials) distances.push_back(std::abs(trial - middle));
  return twincraft::median(distances) / middle;
}

std::string protocol(const Timing& timing) {
  return fmt::format("warmup=1 trials={} interleaved reversed", timing.planned_trials);
}

TimedEngine bare_run(std::shared_ptr<Engine> engine, const Model& model,
                     const std::atomic<bool>* stop) {
  std::string name(engine->name());
  return {std::move(name), [engine = std::move(engine), &model, stop] {
            const auto steps =
                static_cast<std::size_t>(propagate_bare(*engine, model, stop).accepted);
            return stop != nullptr && *stop ? 0 : steps;
          }};
}

bool Timing::complete() const {
  return std::all_of(engines.begin(), engines.end(), [this](const EngineTiming& engine) {
    return static_cast<int>(engine.trials.size()) == planned_trials;
  });
}

std::optional<double> Timing::ratio() const {
  if (engines.size() != 2 || planned_trials == 0 || !complete()) return std::nullopt;
  if (std::max(engines[0].spread(), engines[1].spread()) > kScattered) return std::nullopt;
  return engines[0].median() / engines[1].median();
}

Timing time_engines(const std::vector<TimedEngine>& engines, int trials, const MayGoOn& may_go_on,
                    const Stopwatch& stopwatch) {
  Timing timing{trials, {}};
  const int planned = static_cast<int>(engines.size()) * (1 + trials);
  int done = 0;
  for (const TimedEngine& engine : engines) {
    timing.engines.push_back({engine.name, {}, 0});
    if (may_go_on(done++, planned)) engine.run();
  }
  std::vector<std::size_t> order(engines.size());
  std::iota(order.begin(), order.end(), 0);
  for (int round = 0; round < trials; ++round) {
    for (std::size_t i : order)
      if (may_go_on(done++, planned)) run_trial(engines[i], stopwatch, timing.engines[i]);
    std::reverse(order.begin(), order.end());
  }
  return timing;
}

}  // namespace twincraft
