// What comes before the first step of a run: reading a spec, compiling one of many that are made of
// it, making engines. Prints the best time of each in microseconds. With a stage it does that one
// alone, so that its instructions can be counted in two run lengths.
//
//   bench_compile SPEC [PATH=VALUE [STAGE [ROUNDS]]]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <limits>

#include "compiler/diag/print.h"
#include "compiler/pipeline.h"
#include "runtime/simulate/engines.h"

namespace twincraft::bench {
namespace {

/// The best time of `rounds` calls [s].
double best_time(const std::function<void()>& work, long rounds) {
  using Clock = std::chrono::steady_clock;
  double best = std::numeric_limits<double>::infinity();
  for (long round = 0; round < rounds; ++round) {
    const Clock::time_point start = Clock::now();
    work();
    const std::chrono::duration<double> taken = Clock::now() - start;
    best = std::min(best, taken.count());
  }
  return best;
}

LoadedSpec loaded(const std::string& file) {
  Diagnostics diagnostics;
  LoadResult result = load_spec({file, {}}, diagnostics);
  if (!result.spec) throw std::runtime_error(result.io_error + to_text(diagnostics, {}));
  return *std::move(result.spec);
}

Bundle changed(const LoadedSpec& spec, const std::string& change, const Wanted& wanted) {
  Diagnostics diagnostics;
  std::optional<Bundle> bundle = spec.variant({change}, wanted, diagnostics);
  if (!bundle) throw std::runtime_error(to_text(diagnostics, {}));
  return *std::move(bundle);
}

struct Stage {
  std::string name;
  std::function<void()> work;
};

int run(const std::string& file, const std::string& change, const std::string& only, long rounds) {
  const LoadedSpec spec = loaded(file);
  const Bundle bundle = changed(spec, change, {kMjcf});
  const std::vector<Stage> stages{
      {"load", [&] { loaded(file); }},
      {"member", [&] { changed(spec, change, {}); }},
      {"member with MJCF", [&] { changed(spec, change, {kMjcf}); }},
      {"engine bsm", [&] { make_engine(EngineKind::kBsm, bundle); }},
      {"engine mujoco", [&] { make_engine(EngineKind::kMujoco, bundle); }},
  };
  for (const Stage& stage : stages) {
    if (!only.empty() && only != stage.name) continue;
    fmt::print("{:18} {:8.1f} us\n", stage.name, best_time(stage.work, rounds) * 1.0e6);
  }
  return 0;
}

}  // namespace
}  // namespace twincraft::bench

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto argument = [&](std::size_t i, const char* otherwise) {
    return i < arguments.size() ? arguments[i] : std::string(otherwise);
  };
  try {
    return twincraft::bench::run(argument(0, "models/quickstart.yaml"),
                                 argument(1, "hub.mass=601 kg"), argument(2, ""),
                                 std::atol(argument(3, "300").c_str()));
  } catch (const std::exception& fault) {
    fmt::print(stderr, "bench_compile: {}\n", fault.what());
    return 1;
  }
}
