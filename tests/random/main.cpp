// random_vehicles: as many vehicles as one likes, each held against all that must hold. What fails
// is shrunk and written down. Run as a test over 500 of them; more by tools/random-vehicles.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <thread>

#include "compiler/emit/resolved.h"
#include "tests/random/examine.h"
#include "tests/random/generator.h"
#include "tests/random/shrink.h"

namespace twincraft::random_vehicles {
namespace {

struct Options {
  std::uint64_t count = 500;
  std::uint64_t seed = 1;
  int jobs = 2;
  std::string folder = ".";
  std::string written;  // a folder for specs; empty: they are examined
  std::vector<std::string> replayed;
};

std::optional<Finding> examine(const Json& spec, Record& record) {
  return random_vehicles::examine(emit_resolved(spec), spec.value("name", ""), record);
}

class Hunt {
 public:
  explicit Hunt(const Options& options) : options_(options) {}

  /// @return how many vehicles failed
  int run() {
    std::vector<std::thread> workers;
    for (int i = 0; i < options_.jobs; ++i) workers.emplace_back([this] { work(); });
    for (std::thread& worker : workers) worker.join();
    for (const auto& [check, worst] : record_)
      fmt::print("{:<44} {:.1e}   {}\n", check, worst.value, worst.vehicle);
    fmt::print("{} vehicles from seed {}, {} failed\n", options_.count, options_.seed, failed_);
    return failed_;
  }

 private:
  void work() {
    Record record;
    for (std::uint64_t i = next_++; i < options_.count; i = next_++) {
      const std::uint64_t seed = options_.seed + i;
      const Json spec = random_spec(seed);
      if (const std::optional<Finding> finding = examine(spec, record))
        report(seed, spec, *finding);
    }
    merge(record);
  }

  void report(std::uint64_t seed, const Json& spec, const Finding& finding) {
    Record ignored;
    const Json small = shrink(spec, [&](const Json& candidate) {
      const std::optional<Finding> found = examine(candidate, ignored);
      return found && found->check == finding.check;
    });
    const std::optional<Finding> left = examine(small, ignored);
    const std::string file = fmt::format("{}/vehicle_{}.yaml", options_.folder, seed);
    std::ofstream(file) << "# " << finding.check << "\n" << emit_resolved(small);
    const std::lock_guard lock(mutex_);
    ++failed_;
    fmt::print("seed {}: {}: {}\n  shrunk to {}: {}\n", seed, finding.check, finding.detail, file,
               left ? left->detail : "nothing");
    std::fflush(stdout);
  }

  void merge(const Record& record) {
    const std::lock_guard lock(mutex_);
    for (const auto& [check, worst] : record) {
      Worst& all = record_[check];
      if (!(worst.value <= all.value)) all = worst;
    }
  }

  const Options& options_;
  std::atomic<std::uint64_t> next_ = 0;
  std::mutex mutex_;
  Record record_;
  int failed_ = 0;
};

/// The specs of earlier findings once more. @return how many of them fail
int replay(const std::vector<std::string>& files) {
  int failed = 0;
  for (const std::string& file : files) {
    std::ifstream in(file);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    Record record;
    const std::optional<Finding> found = examine(text, file, record);
    fmt::print("{}: {}\n", file, found ? found->check + ": " + found->detail : "holds");
    if (found) ++failed;
  }
  return failed;
}

void write(const Options& options) {
  for (std::uint64_t seed = options.seed; seed < options.seed + options.count; ++seed)
    std::ofstream(fmt::format("{}/vehicle_{}.yaml", options.written, seed))
        << emit_resolved(random_spec(seed));
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app{"Holds random vehicles against all that must hold.", "random_vehicles"};
  app.add_option("--count", options.count, "how many (default 500)");
  app.add_option("--seed", options.seed, "of the first (default 1); the next have the next seeds");
  app.add_option("--jobs", options.jobs, "at a time (default 2)")->check(CLI::Range(1, 256));
  app.add_option("--output", options.folder, "folder for shrunk counterexamples (default .)")
      ->check(CLI::ExistingDirectory);
  app.add_option("--replay", options.replayed, "examine these specs instead")
      ->check(CLI::ExistingFile);
  app.add_option("--write", options.written, "write the specs into this folder instead")
      ->check(CLI::ExistingDirectory);
  bool print = false;
  app.add_flag("--print", print, "print the first spec instead");
  CLI11_PARSE(app, argc, argv);
  if (print) fmt::print("{}", emit_resolved(random_spec(options.seed)));
  if (print) return 0;
  if (!options.written.empty()) {
    write(options);
    return 0;
  }
  if (!options.replayed.empty()) return replay(options.replayed) == 0 ? 0 : 1;
  return Hunt(options).run() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace twincraft::random_vehicles

int main(int argc, char** argv) { return twincraft::random_vehicles::run(argc, argv); }
