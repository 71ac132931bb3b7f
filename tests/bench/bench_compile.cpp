// What a member of a study costs before it flies: the members of a spec, compiled one after another
// in this process. Says the best time of a member in microseconds, for each target list; with a
// number of rounds, so that instructions can be counted of two run lengths.
//
//   bench_compile SPEC [ROUNDS] [TARGETS] [PATH=VALUE...]    TARGETS: `bsm` or `both`
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <limits>

#include "compiler/diag/print.h"
#include "compiler/pipeline.h"

namespace twincraft::bench {
namespace {

LoadedSpec loaded(const std::string& file, const std::vector<std::string>& settings) {
  Diagnostics diagnostics;
  LoadResult result = load_spec({file, settings}, diagnostics);
  if (!result.spec) throw std::runtime_error(result.io_error + to_text(diagnostics, {}));
  if (result.spec->study() == nullptr) throw std::runtime_error(file + " has no study");
  return *std::move(result.spec);
}

/// The best time of one member [s].
double time_members(const LoadedSpec& spec, const Wanted& wanted, long rounds) {
  using Clock = std::chrono::steady_clock;
  double best = std::numeric_limits<double>::infinity();
  for (long round = 0; round < rounds; ++round) {
    const std::size_t index = static_cast<std::size_t>(round) % spec.study()->members;
    Diagnostics diagnostics;
    const Clock::time_point start = Clock::now();
    const std::optional<Bundle> bundle = spec.member(index, wanted, diagnostics);
    const std::chrono::duration<double> taken = Clock::now() - start;
    if (!bundle) throw std::runtime_error(to_text(diagnostics, {}));
    best = std::min(best, taken.count());
  }
  return best;
}

int run(int argc, char** argv) {
  if (argc < 2) return 2;
  const long rounds = argc > 2 ? std::atol(argv[2]) : 1000;
  const Wanted wanted = argc > 3 && argv[3] == std::string("both") ? Wanted{kMjcf} : Wanted{};
  const LoadedSpec spec = loaded(argv[1], {argv + std::min(argc, 4), argv + argc});
  fmt::print("{:.1f} us a member\n", time_members(spec, wanted, rounds) * 1.0e6);
  return 0;
}

}  // namespace
}  // namespace twincraft::bench

int main(int argc, char** argv) {
  try {
    return twincraft::bench::run(argc, argv);
  } catch (const std::exception& fault) {
    fmt::print(stderr, "bench_compile: {}\n", fault.what());
    return 1;
  }
}
