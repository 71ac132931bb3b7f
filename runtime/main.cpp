// scsim: flags to compiler to run to report to exit code. Results go to standard output and to
// files, diagnostics and progress to standard error. Tested by tests/agreement/scsim_test.cpp.
#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <filesystem>

#include "compiler/cli.h"
#include "compiler/diag/print.h"
#include "compiler/output.h"
#include "compiler/pipeline.h"
#include "runtime/interrupt.h"
#include "runtime/report/csv.h"
#include "runtime/report/json.h"
#include "runtime/report/progress.h"
#include "runtime/report/table.h"

namespace twincraft {
namespace {

struct Options {
  CompileRequest request;
  std::string folder;  // empty: no files
  std::string step, integrator, duration;
  std::string engine = "both";
  int trials = RunOptions{}.trials;
  bool no_timing = false;
  bool quiet = false;
  std::string progress = "auto";
  std::string diagnostics = "text";
};

void complain(std::string_view text) { fmt::print(stderr, "scsim: {}\n", text); }

void describe_run(CLI::App& app, Options& options) {
  app.add_option("spec", options.request.file, "spacecraft spec, or - for standard input")
      ->type_name("SPEC")
      ->required();
  app.add_option("-o,--output", options.folder, "write report.json, bsm.csv and mujoco.csv here")
      ->type_name("DIR");
  app.add_option("--set", options.request.overrides, "change the spec first; repeatable")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  app.add_option("--step", options.step, "same as --set simulation.step=VALUE")->type_name("VALUE");
  app.add_option("--integrator", options.integrator, "same as --set simulation.integrator=VALUE")
      ->type_name("VALUE");
  app.add_option("--duration", options.duration, "same as --set simulation.duration=VALUE")
      ->type_name("VALUE");
  app.add_option("--engine", options.engine, "bsm, mujoco or both (default)")
      ->type_name("ENGINE")
      ->check(one_of({"bsm", "mujoco", "both"}));
}

void describe_output(CLI::App& app, Options& options) {
  app.add_option("--trials", options.trials, "timed trials per engine (default 5; 0: no timing)")
      ->type_name("N")
      ->check(CLI::Range(0, 1'000'000).description(""));
  app.add_flag("--no-timing", options.no_timing, "same as --trials 0");
  app.add_flag("--quiet", options.quiet, "print no report and no progress");
  app.add_option("--progress", options.progress, "auto (default), always or never")
      ->type_name("WHEN")
      ->check(one_of({"auto", "always", "never"}));
  app.add_option("--diagnostics", options.diagnostics, "text (default) or json")
      ->type_name("FORMAT")
      ->check(one_of({"text", "json"}));
}

void describe(CLI::App& app, Options& options) {
  describe_run(app, options);
  describe_output(app, options);
  app.set_help_flag("-h,--help", "print this");
  app.set_version_flag("--version", "scsim " TWINCRAFT_VERSION, "print the version");
  app.get_formatter()->column_width(28);
  app.footer(
      "Exit: 0 done, 1 faults in the spec or a tolerance exceeded, 2 usage, 3 input/output,\n"
      "4 numerical failure, 130/143 interrupted (what was computed is written).\n\n"
      "Example: scsim models/quickstart.yaml -o out --step '10 ms' --engine both");
}

using Settings = std::vector<std::pair<std::string, std::string>>;

/// Every change to the spec the command line asks for, as path and value.
Settings settings_of(const Options& options) {
  Settings settings;
  for (const std::string& text : options.request.overrides) {
    const std::size_t equals = text.find('=');
    if (equals != std::string::npos)
      settings.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return settings;
}

void translate_conveniences(Options& options) {
  const auto set = [&options](const char* path, const std::string& value) {
    if (!value.empty()) options.request.overrides.push_back(fmt::format("{}={}", path, value));
  };
  set("simulation.step", options.step);
  set("simulation.integrator", options.integrator);
  set("simulation.duration", options.duration);
  if (options.no_timing) options.trials = 0;
}

int print(std::string_view text) {
  const std::string error = write_standard_output(text);
  if (error.empty()) return kExitDone;
  complain(error);
  return kExitInputOutput;
}

int print_diagnostics(const Diagnostics& diagnostics, const Options& options) {
  if (options.diagnostics == "json") return print(to_json(diagnostics));
  PrintOptions look;
  look.colour = wants_colour(STDERR_FILENO);
  fmt::print(stderr, "{}", to_text(diagnostics, look));
  return kExitDone;
}

bool shows_progress(const Options& options) {
  if (options.quiet || options.progress == "never") return false;
  return options.progress == "always" || ::isatty(STDERR_FILENO) != 0;
}

RunOptions run_options(const Options& options, ProgressBar& bar) {
  RunOptions run;
  run.bsm = options.engine != "mujoco";
  run.mujoco = options.engine != "bsm";
  run.trials = options.trials;
  run.stop = &watch_for_interrupts();
  if (shows_progress(options))
    run.progress = [&bar](std::string_view phase, double fraction) { bar.show(phase, fraction); };
  return run;
}

int write_results(const Report& report, const std::string& folder) {
  if (folder.empty()) return kExitDone;
  const std::filesystem::path path(folder);
  std::vector<OutputFile> files{{(path / "report.json").string(), report_json(report)}};
  const ReportedMember& first = report.members.front();
  for (const EngineRun& run : first.result.engines)
    if (!run.trajectory.samples.empty())
      files.push_back({(path / (run.name + ".csv")).string(),
                       trajectory_csv(first.bundle.model, run.trajectory)});
  const std::string error = write_files(files);
  if (error.empty()) return kExitDone;
  complain(error);
  return kExitInputOutput;
}

/// Files first: a reader of the report who leaves early must not cost the results.
int deliver(const Report& report, const Options& options) {
  const int written = write_results(report, options.folder);
  // With JSON diagnostics standard output holds that one document.
  if (options.quiet || options.diagnostics == "json") return written;
  const int printed = print(report_table(report.members.front(), wants_colour(STDOUT_FILENO)));
  return written != kExitDone ? written : printed;
}

int complain_of_failures(const Member& member) {
  for (const EngineRun& run : member.engines)
    if (run.status == EngineRun::Status::kFailed)
      complain(fmt::format("{} failed: {}", run.name, run.reason));
  return member.failed() ? kExitFailure : kExitDone;
}

int exit_code(const Report& report) {
  if (const int interrupted = interrupt_exit_code(); interrupted != 0) return interrupted;
  const int failed = complain_of_failures(report.members.front().result);
  if (failed != kExitDone) return failed;
  return report.verdict() == Verdict::kDisagree ? kExitFindings : kExitDone;
}

int simulate(Bundle bundle, const Options& options) {
  ProgressBar bar(stderr);
  const RunOptions run = run_options(options, bar);
  const std::string refusal = reference_refusal(bundle.model, run);
  if (!refusal.empty()) {
    complain(fmt::format("{}: error: {}", bundle.spec_file, refusal));
    return kExitFindings;
  }
  Report report{provenance(), {}};
  Member member = run_member(bundle, run);
  bar.clear();
  report.members.push_back({std::move(bundle), settings_of(options), std::move(member)});
  const int delivered = deliver(report, options);
  return delivered != kExitDone ? delivered : exit_code(report);
}

int compile_and_simulate(const Options& options) {
  Sources sources;
  Diagnostics diagnostics;
  CompileResult result = compile(options.request, sources, diagnostics);
  if (!result.io_error.empty()) {
    complain(result.io_error);
    return kExitInputOutput;
  }
  if (const int code = print_diagnostics(diagnostics, options); code != kExitDone) return code;
  if (!result.bundle) return kExitFindings;
  return simulate(std::move(*result.bundle), options);
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{"Runs a spacecraft spec in both engines and says whether they agree.", "scsim"};
  Options options;
  describe(app, options);
  if (const std::optional<int> code = parse_command_line(app, argc, argv)) return *code;
  translate_conveniences(options);
  return compile_and_simulate(options);
}

}  // namespace
}  // namespace twincraft

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is an error of write(), with a message
  try {
    return twincraft::parse_and_run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "scsim: {}\n", error.what());
    return twincraft::kExitFailure;
  }
}
