// Flags to compiler to variants to attribution to report to exit code.
// Tested by tests/agreement/attribution_test.cpp.
#include "tools/programs/attribute.h"

#include <fmt/format.h>
#include <unistd.h>

#include "compiler/files/output.h"
#include "runtime/delivery/attribution_run.h"
#include "runtime/delivery/report_files.h"
#include "runtime/delivery/room.h"
#include "runtime/report/attribution_words.h"
#include "tools/programs/command.h"
#include "tools/programs/interrupt.h"

namespace twincraft {
namespace {

/// Text in lines of at most `width` characters.
std::string wrapped(std::string_view text, std::size_t width) {
  std::string lines;
  while (text.size() > width) {
    const std::size_t end = text.rfind(' ', width);
    lines += fmt::format("{}\n", text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  return lines.append(text);
}

void describe(CommandLine& line, CommonOptions& options) {
  describe_input(line, options, "report.json and report.html");
  describe_instructions(line, options);
  describe_jobs(line, options, "variants at a time (default: all cores)");
  describe_talk(line, options);
  line.set_column(28);
  line.add_footer(fmt::format(
      "Variants: co-moving frame, token masses and inertias taken away, one gravity law, one\n"
      "attitude chart; each as far as it applies. A study is left out: the spec itself is run.\n"
      "{}\n\n"
      "Exit: 0 explained, 1 faults in the spec, 2 usage, 3 input/output, 4 numerical failure,\n"
      "130/143 interrupted.\n\n"
      "Example: scsim attribute models/paper/rw_panels.yaml --set engines.mujoco.compensate=false",
      wrapped(attribution_method(), 92)));
}

/// Files first, as in scsim. @return the exit code
int deliver(const AttributionRun& run, const CommonOptions& options) {
  if (!run.attributed()) complain(run.complaint());
  const int written = options.folder.empty() ? kExitDone : settle(run.save(options.folder));
  if (!run.attributed()) return written;
  if (written == kExitDone && !options.folder.empty())
    tell_written({"report.json", "report.html"}, options);
  if (!prints_report(options)) return written;
  const int printed = print(run.text(wants_colour(STDOUT_FILENO)));
  return written != kExitDone ? written : printed;
}

int explain(CompiledSpec compiled, const CommonOptions& options) {
  ProgressBar bar(stderr);
  AttributionRequest request;
  watch(request.options, options, bar);
  request.jobs = jobs_of(options);
  const AttributionRun run = attribute(std::move(compiled), request);
  bar.clear();
  if (const int delivered = deliver(run, options); delivered != kExitDone) return delivered;
  if (const int interrupted = interrupt_exit_code(); interrupted != 0) return interrupted;
  if (run.attributed() && !run.complete()) complain(run.complaint());
  return run.exit_code();
}

/// Whether memory holds the trajectories, said now. @return the exit code
int check_kept(const CompiledSpec& compiled, const CommonOptions& options) {
  AttributionRequest request;
  request.jobs = jobs_of(options);
  Diagnostics diagnostics;
  if (check_memory(compiled, request.trajectories(), diagnostics)) return kExitDone;
  const int printed = print_diagnostics(diagnostics, options);
  return printed != kExitDone ? printed : kExitFindings;
}

}  // namespace

int attribute_command(int argc, char** argv) {
  CommandLine line{"Explains why the two engines differ on a spec: how much each cause carries.",
                   "scsim attribute"};
  CommonOptions options;
  describe(line, options);
  if (const std::optional<int> code = line.parse(argc, argv)) return *code;
  if (const std::optional<int> code = settle_flags("scsim attribute", options)) return *code;
  const Wanted wanted = wanted_by_attribution(!options.folder.empty());
  std::optional<CompiledSpec> compiled;
  if (const int code = compile_spec(options, wanted, compiled); code != kExitDone) return code;
  if (const int code = check_kept(*compiled, options); code != kExitDone) return code;
  if (const int code = settle(try_files(report_paths(options.folder))); code != kExitDone)
    return code;
  return explain(*std::move(compiled), options);
}

}  // namespace twincraft
