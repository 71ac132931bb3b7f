// Whole RK4 steps of one spec.
//   bench_steps SPEC [--set PATH=VALUE]... --engine E [--steps N]    runs them and exits: for
//                                                                    callgrind and perf; with
//                                                                    --recorded as scsim records
//   bench_steps SPEC [--set PATH=VALUE]... [--steps N] [--trials N]  a race in one process by the
//                                                                    timing protocol; JSON
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <nlohmann/json.hpp>

#include "runtime/bsm/engine.h"
#include "runtime/mujoco/engine.h"
#include "runtime/simulate/propagate.h"
#include "runtime/simulate/timing.h"
#include "tests/bench/raw_mujoco.h"
#include "tests/bench/vehicle.h"
#include "tools/programs/cli.h"
#include "tools/programs/command_line.h"

namespace twincraft::bench {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string spec;
  std::vector<std::string> settings;
  std::string engine;  // empty: a race
  bool recorded = false;
  int steps = 1000;
  int trials = 15;
};

TimedEngine raw_run(const std::string& name, const Bundle& bundle, Pipeline pipeline) {
  const auto raw = std::make_shared<RawMujoco>(bundle.text(kMjcf), pipeline);
  const SimulationPlan& plan = bundle.model.simulation;
  const auto steps = static_cast<std::size_t>(std::lround(plan.duration / plan.step));
  return {name, [raw, steps, h = plan.step] { return run_raw(*raw, h, steps); }};
}

std::unique_ptr<Engine> engine_of(const std::string& name, const Bundle& bundle) {
  const Model& model = bundle.model;
  if (name == "mujoco") return make_mujoco_engine(model, bundle.text(kMjcf));
  return make_bsm_engine(
      model, name == "portable" ? bsm::InstructionSet::kPortable : bsm::best_instruction_set());
}

TimedEngine contestant(const std::string& name, const Bundle& bundle) {
  if (name == "forward") return raw_run(name, bundle, Pipeline::kForward);
  if (name == "minimal") return raw_run(name, bundle, Pipeline::kMinimal);
  return bare_run(engine_of(name, bundle), bundle.model);
}

/// Records and books as in a run of scsim; what is made of the samples is not in it.
struct Forgetful : SampleSink {
  void take(const Observation&, const Books&) override {}
};

void run_recorded(Engine& engine, const Model& model) {
  Forgetful sink;
  RecordedRun(engine, model, sink).advance_until(model.simulation.duration);
}

int run_alone(const Options& options, const Bundle& bundle) {
  if (options.recorded)
    run_recorded(*engine_of(options.engine, bundle), bundle.model);
  else
    contestant(options.engine, bundle).run();
  return kExitDone;
}

/// What this thread computed [s]: a trial that another process interrupted costs no more, or the
/// engine with the longer trials would be the one that is interrupted.
double cpu_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1.0e-9 * static_cast<double>(now.tv_nsec);
}

/// A contestant and the processor time of each of its runs [s], warm-ups included.
struct Contestant {
  TimedEngine engine;
  std::shared_ptr<std::vector<double>> times = std::make_shared<std::vector<double>>();

  explicit Contestant(TimedEngine bare) : engine{bare.name, {}} {
    engine.run = [run = std::move(bare.run), to = times] {
      const double begin = cpu_time();
      const std::size_t steps = run();
      to->push_back(cpu_time() - begin);
      return steps;
    };
  }
};

Json race_json(const Options& options, const Bundle& bundle,
               const std::vector<Contestant>& contestants, const Timing& timing) {
  const double scale = 1.0e6 / static_cast<double>(options.steps);
  Json engines = Json::object();
  std::map<std::string, double> best;
  for (const Contestant& each : contestants) {
    const std::vector<double> trials(each.times->begin() + 1, each.times->end());
    best[each.engine.name] = scale * *std::min_element(trials.begin(), trials.end());
    engines[each.engine.name] = {{"best_us_per_step", best[each.engine.name]},
                                 {"median_us_per_step", scale * median(trials)}};
  }
  return {{"spec", options.spec},
          {"settings", options.settings},
          {"degrees_of_freedom", bundle.model.degrees_of_freedom()},
          {"step_s", bundle.model.simulation.step},
          {"steps", options.steps},
          {"protocol", protocol(timing) + " clock=thread_cpu"},
          {"instructions", bsm::name_of(bsm::best_instruction_set())},
          {"engines", engines},
          {"ratios_of_best",
           {{"forward_over_bsm", best["forward"] / best["bsm"]},
            {"mujoco_over_bsm", best["mujoco"] / best["bsm"]},
            {"mujoco_over_minimal", best["mujoco"] / best["minimal"]}}}};
}

int race(const Options& options, const Bundle& bundle) {
  std::vector<Contestant> contestants;
  for (const char* name : {"bsm", "mujoco", "forward", "minimal"})
    contestants.emplace_back(contestant(name, bundle));
  std::vector<TimedEngine> engines;
  for (const Contestant& each : contestants) engines.push_back(each.engine);
  const Timing timing = time_engines(engines, options.trials, [](int, int) { return true; });
  fmt::print("{}\n", race_json(options, bundle, contestants, timing).dump(2));
  return kExitDone;
}

int parse_and_run(int argc, char** argv) {
  CommandLine line("Steps a spacecraft spec, to be counted or timed.", "bench_steps");
  Options options;
  line.add_text("spec", options.spec, "", "spacecraft spec");
  line.add_list("--set", options.settings, "PATH=VALUE", "change the spec first; repeatable");
  line.add_text("--engine", options.engine, "ENGINE", "run this one and print nothing",
                {one_of({"bsm", "portable", "mujoco", "forward", "minimal"})});
  line.add_switch("--recorded", options.recorded,
                  "with --engine: record samples and integrate books");
  line.add_number("--steps", options.steps, 1, 100'000'000, "of one run");
  line.add_number("--trials", options.trials, 1, 10'000, "of each contestant");
  if (const std::optional<int> code = line.parse(argc, argv)) return *code;
  Bundle bundle = compiled(options.spec, options.settings);
  set_steps(bundle.model, options.steps);
  return options.engine.empty() ? race(options, bundle) : run_alone(options, bundle);
}

}  // namespace
}  // namespace twincraft::bench

int main(int argc, char** argv) {
  try {
    return twincraft::bench::parse_and_run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_steps: {}\n", error.what());
    return twincraft::kExitFailure;
  }
}
