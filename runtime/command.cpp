// See command.h. Tested by tests/agreement/scsim_test.cpp.
#include "runtime/command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "compiler/diag/print.h"
#include "compiler/output.h"
#include "runtime/interrupt.h"
#include "runtime/report/html/document.h"
#include "runtime/report/json.h"

namespace twincraft {
namespace {

bool shows_progress(const CommonOptions& options) {
  if (options.quiet || options.progress == "never") return false;
  return options.progress == "always" || ::isatty(STDERR_FILENO) != 0;
}

}  // namespace

void describe_input(CLI::App& app, CommonOptions& options, std::string_view files) {
  app.add_option("spec", options.request.file, "spacecraft spec, or - for standard input")
      ->type_name("SPEC")
      ->required();
  app.add_option("-o,--output", options.folder, fmt::format("write {} here", files))
      ->type_name("DIR");
  app.add_option("--set", options.request.overrides, "change the spec first; repeatable")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  app.add_option("--step", options.step, "same as --set simulation.step=VALUE")->type_name("VALUE");
  app.add_option("--integrator", options.integrator, "same as --set simulation.integrator=VALUE")
      ->type_name("VALUE");
  app.add_option("--duration", options.duration, "same as --set simulation.duration=VALUE")
      ->type_name("VALUE");
}

void describe_jobs(CLI::App& app, CommonOptions& options, const std::string& meaning) {
  app.add_option("--jobs", options.jobs, meaning)
      ->type_name("N")
      ->check(CLI::Range(1, 1024).description(""));
}

void describe_talk(CLI::App& app, CommonOptions& options) {
  app.add_flag("--quiet", options.quiet, "print no report and no progress");
  app.add_option("--progress", options.progress, "auto (default), always or never")
      ->type_name("WHEN")
      ->check(one_of({"auto", "always", "never"}));
  app.add_option("--diagnostics", options.diagnostics, "text (default) or json")
      ->type_name("FORMAT")
      ->check(one_of({"text", "json"}));
  add_warning_flags(app, options.warnings);
}

void translate_conveniences(CommonOptions& options) {
  const auto set = [&options](const char* path, const std::string& value) {
    if (!value.empty()) options.request.overrides.push_back(fmt::format("{}={}", path, value));
  };
  set("simulation.step", options.step);
  set("simulation.integrator", options.integrator);
  set("simulation.duration", options.duration);
}

void complain(std::string_view text) { write_standard_error(fmt::format("scsim: {}\n", text)); }

int print(std::string_view text) {
  const std::string error = write_standard_output(text);
  if (error.empty()) return kExitDone;
  complain(error);
  return kExitInputOutput;
}

int print_diagnostics(const Diagnostics& diagnostics, const CommonOptions& options) {
  if (options.diagnostics == "json") return print(to_json(diagnostics));
  PrintOptions look;
  look.colour = wants_colour(STDERR_FILENO);
  write_standard_error(to_text(diagnostics, look));
  return kExitDone;
}

RunOptions watched_run(const CommonOptions& options, ProgressBar& bar) {
  RunOptions run;
  run.stop = &watch_for_interrupts();
  if (shows_progress(options))
    run.progress = [&bar](std::string_view phase, double fraction) { bar.show(phase, fraction); };
  return run;
}

int jobs_of(const CommonOptions& options) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return options.jobs > 0 ? options.jobs : cores;
}

int compile_spec(const CommonOptions& options, Sources& sources, CompileResult& result) {
  Diagnostics diagnostics;
  result = compile(options.request, sources, diagnostics);
  if (!result.io_error.empty()) {
    complain(result.io_error);
    return kExitInputOutput;
  }
  judge_warnings(options.warnings, diagnostics);
  if (const int code = print_diagnostics(diagnostics, options); code != kExitDone) return code;
  return result.bundle && !diagnostics.has_errors() ? kExitDone : kExitFindings;
}

std::vector<std::string> report_files(const CommonOptions& options) {
  if (options.folder.empty()) return {};
  const std::filesystem::path folder = options.folder;
  return {(folder / "report.json").string(), (folder / "report.html").string()};
}

int check_writable(const std::vector<std::string>& files) {
  const std::string error = try_files(files);
  if (error.empty()) return kExitDone;
  complain(error);
  return kExitInputOutput;
}

int write_report(const Report& report, const CommonOptions& options) {
  const std::vector<std::string> files = report_files(options);
  if (files.empty()) return kExitDone;
  const std::string error =
      write_files({{files[0], report_json(report)}, {files[1], report_html(report)}});
  if (error.empty()) return kExitDone;
  complain(error);
  return kExitInputOutput;
}

bool prints_report(const CommonOptions& options) {
  return !options.quiet && options.diagnostics != "json";
}

}  // namespace twincraft
