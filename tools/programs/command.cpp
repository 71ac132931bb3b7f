// See command.h. Tested by tests/agreement/scsim_test.cpp.
#include "tools/programs/command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

#include "compiler/diag/print.h"
#include "compiler/files/output.h"
#include "runtime/bsm/processor.h"
#include "tools/programs/interrupt.h"

namespace twincraft {
namespace {

/// A flag that stands for a `--set`.
struct Convenience {
  const char* name;
  const char* path;
  std::string value;  // empty: not given
};

std::vector<Convenience> conveniences(const CommonOptions& options) {
  return {{"--step", "simulation.step", options.step},
          {"--integrator", "simulation.integrator", options.integrator},
          {"--duration", "simulation.duration", options.duration}};
}

/// `simulation.step` of `simulation.step = 0.1`.
std::string path_of(const std::string& override) {
  return trimmed(override.substr(0, override.find('=')));
}

/// One path is the other, or leads to a part of it.
bool overlap(const std::string& a, const std::string& b) {
  return a == b || a.starts_with(b + ".") || b.starts_with(a + ".");
}

/// What `--isa` asks for; `auto` is what this processor runs faster.
bsm::Choice instructions_of(const std::string& isa) {
  if (const std::optional<bsm::InstructionSet> set = bsm::instruction_set_of(isa))
    return {*set, "--isa " + isa};
  return bsm::choose(bsm::Use::kOne);
}

/// Empty, or that this processor lacks it.
std::string check_processor(const std::string& isa) {
  if (instructions_of(isa).set <= bsm::this_processor().widest) return {};
  std::vector<std::string_view> has;
  for (const bsm::InstructionSet set : bsm::instruction_sets()) has.push_back(word_of(set));
  return fmt::format("this processor has no `{}`; it has {}", isa, fmt::join(has, ", "));
}

Compilation compile_watched(const CommonOptions& options, const Wanted& wanted,
                            Diagnostics& diagnostics) {
  ProgressBar bar(stderr);
  MemberProgress progress;
  if (shows_progress(options))
    progress = [&bar](std::size_t done, std::size_t planned) {
      bar.show("check", static_cast<double>(done) / static_cast<double>(planned));
    };
  return compile_spec(options.request, wanted, diagnostics, progress);
}

}  // namespace

void describe_input(CommandLine& line, CommonOptions& options, std::string_view files) {
  line.add_text("spec", options.request.file, "SPEC", "spacecraft spec, or - for standard input");
  line.add_text("-o,--output", options.folder, "DIR", fmt::format("write {} here", files));
  line.add_list("--set", options.request.overrides, "PATH=VALUE",
                "change the spec first; repeatable");
  line.add_text("--step", options.step, "VALUE", "same as --set simulation.step=VALUE");
  line.add_text("--integrator", options.integrator, "VALUE",
                "same as --set simulation.integrator=VALUE");
  line.add_text("--duration", options.duration, "VALUE", "same as --set simulation.duration=VALUE");
}

void describe_jobs(CommandLine& line, CommonOptions& options, const std::string& meaning) {
  line.add_number("--jobs", options.jobs, 1, 1024, meaning);
}

void describe_instructions(CommandLine& line, CommonOptions& options) {
  line.add_text("--isa", options.isa, "SET",
                "instructions of the analytic engine: auto (default), portable, avx2, avx512",
                {one_of({"auto", "portable", "avx2", "avx512"}), check_processor});
}

void describe_talk(CommandLine& line, CommonOptions& options) {
  line.add_switch("--quiet", options.quiet, "print no report and no progress");
  line.add_text("--progress", options.progress, "WHEN", "auto (default), always or never",
                {one_of({"auto", "always", "never"})});
  line.add_text("--diagnostics", options.diagnostics, "FORMAT", "text (default) or json",
                {one_of({"text", "json"})});
  add_warning_flags(line, options.warnings);
  line.add_text("--explain", options.explain, "CODE", "what a diagnostic code means, and the cure");
}

std::optional<int> settle_flags(std::string_view program, CommonOptions& options) {
  if (!options.explain.empty()) return explain_code(program, options.explain);
  if (options.request.file.empty())
    return report_usage(program, "SPEC is missing",
                        fmt::format("for example `{} models/quickstart.yaml -o out`", program));
  if (options.folder == "-")
    return report_usage(program, "`-o -` would be standard output, but a report is several files",
                        "name a folder, such as `-o out`; `-o ./-` is a folder named `-`");
  const std::vector<std::string> given = options.request.overrides;
  for (const Convenience& flag : conveniences(options)) {
    if (flag.value.empty()) continue;
    for (const std::string& override : given)
      if (overlap(path_of(override), flag.path))
        return report_usage(program,
                            fmt::format("`{}` and {} set the same", flag.name,
                                        in_backticks("--set " + path_of(override))),
                            "leave one of them out");
    options.request.overrides.push_back(fmt::format("{}={}", flag.path, flag.value));
  }
  return std::nullopt;
}

void complain(std::string_view text) { write_standard_error(fmt::format("scsim: {}\n", text)); }

int print(std::string_view text) { return settle(write_standard_output(text)); }

int print_diagnostics(const Diagnostics& diagnostics, const CommonOptions& options) {
  if (options.diagnostics == "json") return print(to_json(diagnostics));  // safe on terminals too
  PrintOptions look;
  look.colour = wants_colour(STDERR_FILENO);
  write_standard_error(to_text(diagnostics, look));
  return kExitDone;
}

void watch(RunOptions& run, const CommonOptions& options, ProgressBar& bar) {
  run.stop = &watch_for_interrupts();
  run.instructions = instructions_of(options.isa);
  if (shows_progress(options))
    run.progress = [&bar](std::string_view phase, double fraction) { bar.show(phase, fraction); };
}

bool shows_progress(const CommonOptions& options) {
  if (options.quiet || options.progress == "never") return false;
  return options.progress == "always" || ::isatty(STDERR_FILENO) != 0;
}

int jobs_of(const CommonOptions& options) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return options.jobs > 0 ? options.jobs : cores;
}

int compile_spec(const CommonOptions& options, const Wanted& wanted,
                 std::optional<CompiledSpec>& result) {
  Diagnostics diagnostics;
  Compilation made = compile_watched(options, wanted, diagnostics);
  if (!made.io_error.empty()) {
    complain(made.io_error);
    return made.exit_code(diagnostics);
  }
  judge_warnings(options.warnings, diagnostics);
  if (const int code = print_diagnostics(diagnostics, options); code != kExitDone) return code;
  result = std::move(made.compiled);
  return made.exit_code(diagnostics);
}

int settle(const std::string& error) {
  if (error.empty()) return kExitDone;
  complain(error);
  return kExitInputOutput;
}

void tell_written(const std::vector<std::string>& files, const CommonOptions& options) {
  if (options.quiet) return;
  write_standard_error(
      fmt::format("wrote {} to `{}`\n", fmt::join(files, ", "), printable(options.folder)));
}

bool prints_report(const CommonOptions& options) {
  return !options.quiet && options.diagnostics != "json";
}

}  // namespace twincraft
