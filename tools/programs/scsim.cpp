// scsim: flags to compiler to run to report to exit code. Results go to standard output and to
// files, diagnostics and progress to standard error. Tested by tests/agreement/scsim_test.cpp.
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "runtime/report/study_table.h"
#include "runtime/report/table.h"
#include "runtime/study/in_order.h"
#include "runtime/study/run_study.h"
#include "tools/programs/attribute.h"
#include "tools/programs/command.h"
#include "tools/programs/estimate.h"
#include "tools/programs/interrupt.h"
#include "tools/programs/member_files.h"
#include "tools/programs/outcome.h"

namespace twincraft {
namespace {

const std::string kAttribute = "attribute";

struct Options : CommonOptions {
  bool netcdf = false;
  std::string engine = "both";
  int trials = RunOptions{}.trials;
  bool no_timing = false;
};

void describe_run(CommandLine& line, Options& options) {
  describe_input(line, options, "report.json, report.html and CSV files");
  line.add_switch("--netcdf", options.netcdf, "also write trajectories as netCDF-4, with -o");
  line.require("--netcdf", "--output");
  line.add_text("--engine", options.engine, "ENGINE", "bsm, mujoco or both (default)",
                {one_of({std::string(kBsmKey), std::string(kMujocoKey), "both"})});
  line.add_number("--trials", options.trials, 0, 1'000'000,
                  "timed trials per engine (default 5; 0: no timing)");
  line.add_switch("--no-timing", options.no_timing, "same as --trials 0");
  describe_instructions(line, options);
  describe_jobs(line, options,
                "members of a study at a time (default: all cores); timed ones run alone");
}

void describe(CommandLine& line, Options& options) {
  describe_run(line, options);
  describe_talk(line, options);
  line.add_version("scsim " TWINCRAFT_VERSION);
  line.set_column(28);
  line.add_footer(
      "scsim attribute SPEC explains a disagreement; see scsim attribute --help.\n\n"
      "Exit: 0 done, 1 faults in the spec or a tolerance exceeded, 2 usage, 3 input/output,\n"
      "4 numerical failure, 130/143 interrupted (what was computed is written).\n\n"
      "Example: scsim models/quickstart.yaml -o out --step '10 ms' --engine both");
}

/// @param compares_members  a trajectory is needed again when another member has been flown
RunOptions run_options(const Options& options, bool compares_members, ProgressBar& bar) {
  RunOptions run = watched_run(options, bar);
  run.bsm = options.engine != kMujocoKey;
  run.mujoco = options.engine != kBsmKey;
  run.trials = options.trials;
  run.keep_samples = compares_members;
  return run;
}

/// What is sure to be written: the report and the first member's trajectories; nothing without -o.
std::vector<std::string> first_files(const Options& options) {
  std::vector<std::string> files = report_files(options);
  if (files.empty()) return files;
  const std::filesystem::path folder(options.folder);
  for (const EngineName& engine : kEngines)
    files.push_back((folder / fmt::format("{}.csv", engine.key)).string());
  return files;
}

/// The names of what is in the folder now.
std::vector<std::string> written_files(const Outcome& outcome, const Options& options) {
  std::vector<std::string> files{"report.json", "report.html"};
  for (const EngineRun& run : outcome.report().members.front().result.engines) {
    if (run.trajectory.samples.empty()) continue;
    files.push_back(run.name + ".csv");
    if (options.netcdf) files.push_back(run.name + ".nc");
  }
  if (outcome.members() == 2) files.emplace_back("0001/");
  if (outcome.members() > 2) files.push_back(fmt::format("0001/ to {:04}/", outcome.members() - 1));
  return files;
}

/// Files first: a reader of the report who leaves early must not cost the results.
int deliver(Outcome& outcome, const Options& options, const RunOptions& run, ProgressBar& bar) {
  const int written = outcome.write([&run](double done) { run.show("write", done); });
  bar.clear();
  if (written == kExitDone && !options.folder.empty())
    tell_written(written_files(outcome, options), options);
  if (!prints_report(options)) return written;
  const bool colour = wants_colour(STDOUT_FILENO);
  const Report& report = outcome.report();
  const int printed = print(report.study ? study_table(report, colour)
                                         : report_table(report.members.front(), colour));
  return written != kExitDone ? written : printed;
}

int exit_code(const Outcome& outcome) {
  if (const int interrupted = interrupt_exit_code(); interrupted != 0) return interrupted;
  const int failed = outcome.complain_of_failures();
  if (failed != kExitDone) return failed;
  if (outcome.empty()) return kExitDone;
  const Verdict verdict = outcome.report().verdict();
  const bool finds = verdict == Verdict::kDisagree || verdict == Verdict::kUnresolved;
  return finds ? kExitFindings : kExitDone;
}

MemberSpec compile_member(const LoadedSpec& loaded, std::size_t index, const Wanted& wanted) {
  Diagnostics diagnostics;
  MemberSpec spec{loaded.member(index, wanted, diagnostics), {}};
  for (const Diagnostic& fault : diagnostics.all())
    if (!spec.bundle && fault.severity == Severity::kError && spec.refusal.empty())
      spec.refusal = fault.message;
  return spec;
}

/// What member `index` writes; nothing without -o.
std::unique_ptr<MemberOutput> output_of(std::size_t index, const Bundle& bundle,
                                        const Options& options, Outcome& outcome) {
  if (options.folder.empty()) return nullptr;
  return std::make_unique<MemberFiles>(bundle, MemberFilesPlan{index, options.netcdf},
                                       outcome.report().provenance, outcome.output());
}

void run_single(Bundle bundle, const Options& options, RunOptions run, Outcome& outcome) {
  run.side_by_side = jobs_of(options) > 1;
  FlownMember flown = run_one({std::move(bundle), {}}, run, [&](const Bundle& flying) {
    return output_of(0, flying, options, outcome);
  });
  if (flown.output) flown.output->publish(flown.member);
  outcome.take(std::move(flown.member));
}

void run_members(const LoadedSpec& spec, const Options& options, const RunOptions& run,
                 ProgressBar& bar, Outcome& outcome) {
  StudyRun plan;
  plan.plan = *spec.study();
  plan.compile = [&spec, wanted = wanted_by_run(options)](std::size_t index) {
    return compile_member(spec, index, wanted);
  };
  plan.output = [&](std::size_t index, const Bundle& bundle) {
    return output_of(index, bundle, options, outcome);
  };
  plan.finished = [&](std::size_t index, ReportedMember member) {
    if (run.progress) bar.leave(member_line(index, member, *spec.study()));
    outcome.take(std::move(member));
  };
  plan.jobs = jobs_of(options);
  run_study(plan, run);
}

int simulate(CompiledSpec compiled, const Options& options) {
  const StudyPlan* const study = compiled.spec.study();
  ProgressBar bar(stderr, study != nullptr ? 0.0 : compiled.bundle.model.simulation.duration);
  const RunOptions run = run_options(options, study != nullptr && study->compare, bar);
  Outcome outcome(options, study != nullptr ? std::optional(*study) : std::nullopt);
  if (study != nullptr)
    run_members(compiled.spec, options, run, bar, outcome);
  else
    run_single(std::move(compiled.bundle), options, run, outcome);
  bar.clear();
  if (outcome.empty()) return exit_code(outcome);  // interrupted before the first
  const int delivered = deliver(outcome, options, run, bar);
  return delivered != kExitDone ? delivered : exit_code(outcome);
}

/// Trajectories that are in memory at a time, of both engines.
double kept_trajectories(const StudyPlan& plan, int jobs) {
  if (!plan.compare) return 0.0;
  // Of a grid there is a baseline for each combination of the paths that change faster.
  double baselines = 1.0;
  for (std::size_t path = *plan.compare + 1; plan.is_grid && path < plan.lengths.size(); ++path)
    baselines *= static_cast<double>(plan.lengths[path]);
  return 2.0 * (baselines + (1.0 + kEarlyResults) * jobs);
}

/// Whether memory holds what this run keeps, said now. @return the exit code
int check_kept(const CompiledSpec& compiled, const Options& options) {
  if (compiled.spec.study() == nullptr) return kExitDone;
  const int jobs = options.trials > 0 ? 1 : jobs_of(options);
  return check_memory(compiled, kept_trajectories(*compiled.spec.study(), jobs), options);
}

/// The same of the disk and what it writes.
int check_written(const CompiledSpec& compiled, const Options& options) {
  const Model& model = compiled.bundle.model;
  const StudyPlan* const study = compiled.spec.study();
  const double members = study != nullptr ? static_cast<double>(study->members) : 1.0;
  const double engines = options.engine == "both" && model.mujoco_refusal.empty() ? 2.0 : 1.0;
  return check_disk(model, members * engines * file_bytes(model, options.netcdf), options);
}

int compile_and_simulate(const Options& options) {
  std::optional<CompiledSpec> result;
  if (const int code = compile_spec(options, wanted_by_run(options), result); code != kExitDone)
    return code;
  if (const int code = check_kept(*result, options); code != kExitDone) return code;
  if (const int code = check_writable(first_files(options)); code != kExitDone) return code;
  if (const int code = check_written(*result, options); code != kExitDone) return code;
  return simulate(*std::move(result), options);
}

/// A word before all flags that is nearly a command and no file.
bool is_misspelt_command(const std::string& word) {
  return !word.starts_with('-') && !nearest(word, {kAttribute}).empty() &&
         !std::filesystem::exists(word);
}

int parse_and_run(int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  if (first == kAttribute) return attribute_command(argc - 1, argv + 1);
  if (is_misspelt_command(first))
    return report_usage("scsim", fmt::format("unknown command {}", in_backticks(first)),
                        fmt::format("did you mean `{}`?", kAttribute));
  CommandLine line{"Runs a spacecraft spec in both engines and says whether they agree.", "scsim"};
  Options options;
  describe(line, options);
  if (const std::optional<int> code = line.parse(argc, argv)) return *code;
  if (const std::optional<int> code = settle_flags("scsim", options)) return *code;
  if (options.no_timing && line.has("--trials") && options.trials > 0)
    complain("warning: `--trials` has no effect with `--no-timing`");
  if (options.no_timing) options.trials = 0;
  return compile_and_simulate(options);
}

}  // namespace
}  // namespace twincraft

int main(int argc, char** argv) {
  return twincraft::run_program("scsim", [=] { return twincraft::parse_and_run(argc, argv); });
}
