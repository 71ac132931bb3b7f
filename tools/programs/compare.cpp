// Flags to two files to a table to an exit code. Tested by tests/agreement/compare_test.cpp.
#include "tools/programs/compare.h"

#include <fmt/format.h>
#include <unistd.h>

#include "compiler/files/output.h"
#include "runtime/delivery/compare_run.h"
#include "tools/programs/command.h"

namespace twincraft {
namespace {

struct Options : CommonOptions {
  std::string a, b;
};

void describe(CommandLine& line, Options& options) {
  line.add_text("A", options.a, "PATH", "trajectory (CSV), or a folder of them");
  line.add_text("B", options.b, "PATH", "what it is compared with, of the same kind");
  line.add_text("--tolerances", options.request.file, "SPEC",
                "judge by the `agreement` of this spec");
  line.add_list("--set", options.request.overrides, "PATH=VALUE",
                "change the spec first; repeatable");
  line.require("--set", "--tolerances");
  describe_talk(line, options);
  line.set_column(28);
  line.add_footer(
      "Columns are matched by name, in any order and any unit: `t [s]`, `q_BN.w [1]`,\n"
      "`wing.1.position [deg]`. docs/outputs.md lists the names. Only times that both files have,\n"
      "equal to 1e-9 s, are compared: nothing is interpolated. In two folders, files of the same\n"
      "name are compared.\n\n"
      "Exit: 0 agree or not judged, 1 a tolerance exceeded or faults in the spec, 2 usage,\n"
      "3 a file with faults, or nothing in common.\n\n"
      "Example: scsim compare out other/trajectory.csv --tolerances models/quickstart.yaml");
}

/// What the flags say by themselves. @return the exit code, or nothing to go on
std::optional<int> settle_paths(const CommandLine& line, const Options& options) {
  if (!options.explain.empty()) return explain_code("scsim compare", options.explain);
  if (line.has("A") && line.has("B")) return std::nullopt;
  return report_usage("scsim compare",
                      line.has("A") ? "B is missing: two files or folders are compared"
                                    : "A and B are missing: two files or folders are compared",
                      "for example `scsim compare out/bsm.csv other/bsm.csv`");
}

int deliver(const CompareRun& run, const CommonOptions& options) {
  for (const FileFault& fault : run.faults()) write_standard_error(to_text(fault));
  if (!prints_report(options)) return run.exit_code();
  const int printed = print(run.text(wants_colour(STDOUT_FILENO)));
  return printed != kExitDone ? printed : run.exit_code();
}

int compare(const Options& options, const CompiledSpec* spec) {
  ProgressBar bar(stderr);
  CompareRequest request;
  request.a = options.a;
  request.b = options.b;
  if (spec != nullptr) {
    request.spec = &spec->bundle.model;
    request.spec_name = options.request.file;
  }
  if (shows_progress(options))
    request.progress = [&bar](double fraction) { bar.show("compare", fraction); };
  const CompareRun run = compare_files(request);
  bar.clear();
  return deliver(run, options);
}

}  // namespace

int compare_command(int argc, char** argv) {
  CommandLine line{"Compares two trajectories, or two folders of them, at their common times.",
                   "scsim compare"};
  Options options;
  describe(line, options);
  if (const std::optional<int> code = line.parse(argc, argv)) return *code;
  if (const std::optional<int> code = settle_paths(line, options)) return *code;
  std::optional<CompiledSpec> spec;
  const int code = options.request.file.empty() ? print_diagnostics({}, options)
                                                : compile_spec(options, {}, spec);
  if (code != kExitDone) return code;
  return compare(options, spec ? &*spec : nullptr);
}

}  // namespace twincraft
