// Whole RK4 steps of one spec.
//   bench_steps SPEC [--set PATH=VALUE]... --engine E [--steps N]    runs them and exits: for
//                                                                    callgrind and perf; with
//                                                                    --recorded as scsim records
//   bench_steps SPEC [--set PATH=VALUE]... [--steps N] [--trials N]  a race in one process by the
//                                                                    timing protocol; JSON. With
//                                                                    --recorded the engines of
//                                                                    scsim, bare and recorded
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
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

// Contestants: the analytic engine with the instruction set that scsim chooses, or with a named
// one; our MuJoCo engine; MuJoCo's own calls.
constexpr std::string_view kChosen = "bsm", kMujoco = "mujoco", kForward = "forward",
                           kMinimal = "minimal", kStep = "step";
constexpr std::string_view kRecorded = "_recorded";

std::size_t steps_of(const Model& model) {
  return static_cast<std::size_t>(std::lround(model.simulation.duration / model.simulation.step));
}

TimedEngine raw_run(const std::string& name, const Bundle& bundle, Pipeline pipeline) {
  const auto raw = std::make_shared<RawMujoco>(bundle.text(kMjcf), pipeline);
  return {name, [raw, steps = steps_of(bundle.model), h = bundle.model.simulation.step] {
            return run_raw(*raw, h, steps);
          }};
}

TimedEngine plain_run(const std::string& name, const Bundle& bundle) {
  const auto plain =
      std::make_shared<PlainMujoco>(bundle.text(kMjcf), bundle.model.simulation.step);
  return {name, [plain, steps = steps_of(bundle.model)] { return run_raw(*plain, steps); }};
}

std::unique_ptr<Engine> engine_of(const std::string& name, const Bundle& bundle) {
  const Model& model = bundle.model;
  if (name == kMujoco) return make_mujoco_engine(model, bundle.text(kMjcf));
  return make_bsm_engine(
      model, bsm::instruction_set_of(name).value_or(bsm::fastest_instruction_set(bsm::Use::kOne)));
}

/// Records and books as in a run of scsim; what is made of the samples is not in it.
struct Forgetful : SampleSink {
  void take(const Observation&, const Books&) override {}
};

TimedEngine recorded_run(const std::string& name, std::shared_ptr<Engine> engine,
                         const Model& model) {
  return {name, [engine, &model] {
            Forgetful sink;
            RecordedRun(*engine, model, sink).advance_until(model.simulation.duration);
            return steps_of(model);
          }};
}

/// @pre `bundle` outlives it
TimedEngine contestant(const std::string& name, const Bundle& bundle) {
  if (name == kForward) return raw_run(name, bundle, Pipeline::kForward);
  if (name == kMinimal) return raw_run(name, bundle, Pipeline::kMinimal);
  if (name == kStep) return plain_run(name, bundle);
  TimedEngine bare = bare_run(engine_of(name, bundle), bundle.model);
  return {name, std::move(bare.run)};
}

TimedEngine recorded_contestant(const std::string& name, const Bundle& bundle) {
  return recorded_run(name + std::string(kRecorded), engine_of(name, bundle), bundle.model);
}

/// All that race: the chosen set and the other wide ones, then MuJoCo; or the bare engines and the
/// recorded ones.
std::vector<TimedEngine> contestants_of(const Options& options, const Bundle& bundle) {
  std::vector<TimedEngine> all{contestant(std::string(kChosen), bundle)};
  if (options.recorded) {
    all.push_back(recorded_contestant(std::string(kChosen), bundle));
    all.push_back(contestant(std::string(kMujoco), bundle));
    all.push_back(recorded_contestant(std::string(kMujoco), bundle));
    return all;
  }
  for (const bsm::InstructionSet set : bsm::instruction_sets())
    if (set != bsm::InstructionSet::kPortable &&
        set != bsm::fastest_instruction_set(bsm::Use::kOne))
      all.push_back(contestant(std::string(word_of(set)), bundle));
  for (const std::string_view name : {kMujoco, kForward, kMinimal, kStep})
    all.push_back(contestant(std::string(name), bundle));
  return all;
}

int run_alone(const Options& options, const Bundle& bundle) {
  (options.recorded ? recorded_contestant : contestant)(options.engine, bundle).run();
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

/// Which contestant flew with which instruction set.
Json contestants_by_set(const Json& engines) {
  Json sets = Json::object();
  for (const bsm::InstructionSet set : bsm::instruction_sets()) {
    const bool is_chosen = set == bsm::fastest_instruction_set(bsm::Use::kOne);
    const std::string_view name = is_chosen ? kChosen : word_of(set);
    if (engines.contains(name)) sets[std::string(name_of(set))] = name;
  }
  return sets;
}

Json race_json(const Options& options, const Bundle& bundle,
               const std::vector<Contestant>& contestants, const Timing& timing) {
  const double scale = 1.0e6 / static_cast<double>(options.steps);
  Json engines = Json::object();
  for (const Contestant& each : contestants) {
    const std::vector<double> trials(each.times->begin() + 1, each.times->end());
    engines[each.engine.name] = {
        {"best_us_per_step", scale * *std::min_element(trials.begin(), trials.end())},
        {"median_us_per_step", scale * median(trials)}};
  }
  return {{"spec", options.spec},
          {"settings", options.settings},
          {"degrees_of_freedom", bundle.model.degrees_of_freedom()},
          {"step_s", bundle.model.simulation.step},
          {"steps", options.steps},
          {"protocol", protocol(timing) + " clock=thread_cpu"},
          {"instructions", name_of(bsm::fastest_instruction_set(bsm::Use::kOne))},
          {"sets", contestants_by_set(engines)},
          {"engines", engines}};
}

int race(const Options& options, const Bundle& bundle) {
  std::vector<Contestant> contestants;
  for (TimedEngine& each : contestants_of(options, bundle))
    contestants.emplace_back(std::move(each));
  std::vector<TimedEngine> engines;
  for (const Contestant& each : contestants) engines.push_back(each.engine);
  const Timing timing = time_engines(engines, options.trials, [](int, int) { return true; });
  fmt::print("{}\n", race_json(options, bundle, contestants, timing).dump(2));
  return kExitDone;
}

/// What this processor can run.
std::vector<std::string> engine_words() {
  std::vector<std::string> words{std::string(kChosen)};
  for (const bsm::InstructionSet set : bsm::instruction_sets()) words.emplace_back(word_of(set));
  for (const std::string_view name : {kMujoco, kForward, kMinimal, kStep}) words.emplace_back(name);
  return words;
}

int parse_and_run(int argc, char** argv) {
  CommandLine line("Steps a spacecraft spec, to be counted or timed.", "bench_steps");
  Options options;
  line.add_text("spec", options.spec, "", "spacecraft spec");
  line.add_list("--set", options.settings, "PATH=VALUE", "change the spec first; repeatable");
  line.add_text("--engine", options.engine, "ENGINE", "run this one and print nothing",
                {one_of(engine_words())});
  line.add_switch("--recorded", options.recorded,
                  "record samples and integrate books; in a race, beside the bare runs");
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
