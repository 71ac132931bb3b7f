// scsim: flags to compiler to run to report to exit code. Results go to standard output and to
// files, diagnostics and progress to standard error. Tested by tests/agreement/scsim_test.cpp.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "compiler/output.h"
#include "runtime/attribute.h"
#include "runtime/command.h"
#include "runtime/interrupt.h"
#include "runtime/members.h"
#include "runtime/report/csv.h"
#include "runtime/report/netcdf.h"
#include "runtime/report/study_table.h"
#include "runtime/report/table.h"

namespace twincraft {
namespace {

const std::string kAttribute = "attribute";

struct Options : CommonOptions {
  bool netcdf = false;
  std::string engine = "both";
  int trials = RunOptions{}.trials;
  bool no_timing = false;
};

void describe_run(CLI::App& app, Options& options) {
  describe_input(app, options, "report.json, report.html and CSV files");
  app.add_flag("--netcdf", options.netcdf, "also write trajectories as netCDF-4, with -o")
      ->needs(app.get_option("--output"));
  app.add_option("--engine", options.engine, "bsm, mujoco or both (default)")
      ->type_name("ENGINE")
      ->check(one_of({"bsm", "mujoco", "both"}));
  app.add_option("--trials", options.trials, "timed trials per engine (default 5; 0: no timing)")
      ->type_name("N")
      ->check(CLI::Range(0, 1'000'000).description(""));
  app.add_flag("--no-timing", options.no_timing, "same as --trials 0");
  describe_jobs(app, options,
                "members of a study at a time (default: all cores); timed ones run alone");
}

void describe(CLI::App& app, Options& options) {
  describe_run(app, options);
  describe_talk(app, options);
  app.set_help_flag("-h,--help", "print this");
  app.set_version_flag("--version", "scsim " TWINCRAFT_VERSION, "print the version");
  app.get_formatter()->column_width(28);
  app.footer(
      "scsim attribute SPEC explains a disagreement; see scsim attribute --help.\n\n"
      "Exit: 0 done, 1 faults in the spec or a tolerance exceeded, 2 usage, 3 input/output,\n"
      "4 numerical failure, 130/143 interrupted (what was computed is written).\n\n"
      "Example: scsim models/quickstart.yaml -o out --step '10 ms' --engine both");
}

RunOptions run_options(const Options& options, ProgressBar& bar) {
  RunOptions run = watched_run(options, bar);
  run.bsm = options.engine != "mujoco";
  run.mujoco = options.engine != "bsm";
  run.trials = options.trials;
  return run;
}

/// DIR, or DIR/0001 and so on: the first member's files lie beside the report.
std::filesystem::path folder_of(std::size_t index, const Options& options) {
  const std::filesystem::path folder(options.folder);
  return index == 0 ? folder : folder / fmt::format("{:04}", index);
}

/// What is sure to be written: the report and the first member's trajectories; nothing without -o.
std::vector<std::string> first_files(const Options& options) {
  std::vector<std::string> files = report_files(options);
  if (files.empty()) return files;
  for (const char* name : {"bsm.csv", "mujoco.csv"})
    files.push_back((folder_of(0, options) / name).string());
  return files;
}

/// @return empty, or what went wrong
std::string write_trajectories(std::size_t index, const ReportedMember& member,
                               const Options& options) {
  std::vector<OutputFile> files;
  const std::filesystem::path folder = folder_of(index, options);
  for (const EngineRun& run : member.result.engines) {
    if (run.trajectory.samples.empty()) continue;
    files.push_back({(folder / (run.name + ".csv")).string(),
                     trajectory_csv(member.bundle.model, run.trajectory)});
    if (options.netcdf)
      files.push_back({(folder / (run.name + ".nc")).string(),
                       trajectory_netcdf(member.bundle, run, provenance())});
  }
  return files.empty() ? std::string() : write_files(files);
}

/// The names of what is in the folder now.
std::vector<std::string> written_files(const Report& report, const Options& options) {
  std::vector<std::string> files{"report.json", "report.html"};
  for (const EngineRun& run : report.members.front().result.engines) {
    if (run.trajectory.samples.empty()) continue;
    files.push_back(run.name + ".csv");
    if (options.netcdf) files.push_back(run.name + ".nc");
  }
  if (report.members.size() == 2) files.emplace_back("0001/");
  if (report.members.size() > 2)
    files.push_back(fmt::format("0001/ to {:04}/", report.members.size() - 1));
  return files;
}

/// Files first: a reader of the report who leaves early must not cost the results.
int deliver(const Report& report, const Options& options) {
  const int written = write_report(report, options);
  if (written == kExitDone && !options.folder.empty())
    tell_written(written_files(report, options), options);
  if (!prints_report(options)) return written;
  const bool colour = wants_colour(STDOUT_FILENO);
  const int printed = print(report.study ? study_table(report, colour)
                                         : report_table(report.members.front(), colour));
  return written != kExitDone ? written : printed;
}

/// Says what failed. @return how bad the worst member is
int complain_of_failures(const Report& report) {
  int code = kExitDone;
  for (std::size_t i = 0; i < report.members.size(); ++i) {
    const Member& member = report.members[i].result;
    // What diverges in a work-precision study is a result, but not its reference or check.
    const bool may_diverge =
        report.study && report.study->is_work_precision && i + 2 < report.study->members;
    const std::string which = report.study ? fmt::format("member {}: ", i) : "";
    if (member.refused) complain(fmt::format("{}error: {}", which, member.engines[0].reason));
    if (member.refused) code = std::max<int>(code, kExitFindings);
    if (may_diverge || !member.failed()) continue;
    for (const EngineRun& run : member.engines)
      if (run.status == EngineRun::Status::kFailed)
        complain(fmt::format("{}{} failed: {}", which, run.name, run.reason));
    code = kExitFailure;
  }
  return code;
}

int exit_code(const Report& report) {
  if (const int interrupted = interrupt_exit_code(); interrupted != 0) return interrupted;
  const int failed = complain_of_failures(report);
  if (failed != kExitDone) return failed;
  const Verdict verdict = report.verdict();
  const bool finds = verdict == Verdict::kDisagree || verdict == Verdict::kUnresolved;
  return finds ? kExitFindings : kExitDone;
}

MemberSpec compile_member(const Study& study, std::size_t index) {
  Diagnostics diagnostics;
  MemberSpec spec{study.compile(index, diagnostics), {}};
  for (const Diagnostic& fault : diagnostics.all())
    if (!spec.bundle && fault.severity == Severity::kError && spec.refusal.empty())
      spec.refusal = fault.message;
  return spec;
}

/// The whole study, or the spec as the one member there is.
std::vector<ReportedMember> run_members(CompileResult& compiled, const Options& options,
                                        const RunOptions& run, ProgressBar& bar,
                                        std::string& write_error) {
  const auto finished = [&](std::size_t index, const ReportedMember& member) {
    if (compiled.study && run.progress)
      bar.leave(member_line(index, member, compiled.study->plan()));
    if (options.folder.empty() || !write_error.empty()) return;
    write_error = write_trajectories(index, member, options);
  };
  std::vector<ReportedMember> members;
  if (!compiled.study) {
    members.push_back(run_one({std::move(compiled.bundle), {}}, run));
    finished(0, members.front());
    return members;
  }
  const Study& study = *compiled.study;
  return run_study(
      {study.plan(), [&study](std::size_t index) { return compile_member(study, index); }, finished,
       jobs_of(options)},
      run);
}

int simulate(CompileResult compiled, const Options& options) {
  ProgressBar bar(stderr, compiled.study ? 0.0 : compiled.bundle->model.simulation.duration);
  const RunOptions run = run_options(options, bar);
  std::string write_error;
  Report report{provenance(), run_members(compiled, options, run, bar, write_error)};
  bar.clear();
  if (compiled.study) report.study = compiled.study->plan();
  if (report.members.empty()) return exit_code(report);  // interrupted before the first
  Options told = options;
  if (!write_error.empty()) told.folder.clear();  // the table still is worth printing
  const int delivered = deliver(report, told);
  if (!write_error.empty()) {
    complain(write_error);
    return kExitInputOutput;
  }
  return delivered != kExitDone ? delivered : exit_code(report);
}

int compile_and_simulate(const Options& options) {
  Sources sources;
  CompileResult result;
  if (const int code = compile_spec(options, sources, result); code != kExitDone) return code;
  if (const int code = check_writable(first_files(options)); code != kExitDone) return code;
  return simulate(std::move(result), options);
}

/// A word before all flags that is nearly a command and no file.
bool is_misspelt_command(const std::string& word) {
  return !word.starts_with("-") && !nearest(word, {kAttribute}).empty() &&
         !std::filesystem::exists(word);
}

int parse_and_run(int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  if (first == kAttribute) return attribute_command(argc - 1, argv + 1);
  if (is_misspelt_command(first))
    return report_usage("scsim", fmt::format("unknown command {}", in_backticks(first)),
                        fmt::format("did you mean `{}`?", kAttribute));
  CLI::App app{"Runs a spacecraft spec in both engines and says whether they agree.", "scsim"};
  Options options;
  describe(app, options);
  if (const std::optional<int> code = parse_command_line(app, argc, argv)) return *code;
  if (const std::optional<int> code = settle_flags("scsim", options)) return *code;
  if (options.no_timing && app.get_option("--trials")->count() > 0 && options.trials > 0)
    complain("warning: `--trials` has no effect with `--no-timing`");
  if (options.no_timing) options.trials = 0;
  return compile_and_simulate(options);
}

}  // namespace
}  // namespace twincraft

int main(int argc, char** argv) {
  return twincraft::run_program("scsim", [=] { return twincraft::parse_and_run(argc, argv); });
}
