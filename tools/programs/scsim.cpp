// scsim: flags to compiler to run to report to exit code. Results go to standard output and to
// files, diagnostics and progress to standard error. Tested by tests/agreement/scsim_test.cpp.
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "compiler/files/output.h"
#include "runtime/delivery/campaign_files.h"
#include "runtime/delivery/room.h"
#include "runtime/delivery/spec_run.h"
#include "runtime/report/netcdf.h"
#include "runtime/report/study_table.h"
#include "tools/programs/attribute.h"
#include "tools/programs/campaign.h"
#include "tools/programs/command.h"
#include "tools/programs/compare.h"
#include "tools/programs/interrupt.h"

namespace twincraft {
namespace {

const std::string kAttribute = "attribute", kCompare = "compare", kMerge = "merge";

struct Options : CommonOptions {
  bool netcdf = false;
  std::string engine;  // empty: both
  int trials = RunOptions{}.trials;
  bool no_timing = false;
  CampaignOptions campaign;
};

void describe_run(CommandLine& line, Options& options) {
  describe_input(line, options, "report.json, report.html and CSV files");
  line.add_switch("--netcdf", options.netcdf, "also write trajectories as netCDF-4, with -o");
  line.require("--netcdf", "--output");
  line.add_text("--engine", options.engine, "ENGINE",
                "bsm, mujoco or both (default; of a campaign: bsm, and both as its `twin` says)",
                {one_of({std::string(kBsmKey), std::string(kMujocoKey), "both"})});
  line.add_number("--trials", options.trials, 0, 1'000'000,
                  "timed trials per engine (default 5; 0: no timing)");
  line.add_switch("--no-timing", options.no_timing, "same as --trials 0");
  describe_instructions(line, options);
  describe_jobs(
      line, options,
      "members of a study or campaign at a time (default: all cores); timed ones run alone");
}

void describe(CommandLine& line, Options& options) {
  describe_run(line, options);
  describe_campaign(line, options.campaign);
  describe_talk(line, options);
  line.add_version("scsim " TWINCRAFT_VERSION);
  line.set_column(28);
  line.add_footer(
      "scsim attribute SPEC explains a disagreement; see scsim attribute --help.\n"
      "scsim compare A B compares trajectories or folders; see scsim compare --help.\n"
      "scsim merge DIR joins the shards of a campaign; see scsim merge --help.\n\n"
      "Exit: 0 done, 1 faults in the spec or a tolerance exceeded, 2 usage, 3 input/output,\n"
      "4 numerical failure, 130/143 interrupted (what was computed is written).\n\n"
      "Example: scsim models/quickstart.yaml -o out --step '10 ms' --engine both");
}

/// What the flags ask for, without anybody who watches.
RunRequest request_of(const Options& options) {
  RunRequest request;
  request.options.bsm = options.engine != kMujocoKey;
  request.options.mujoco = options.engine != kBsmKey;
  request.options.trials = options.trials;
  request.jobs = jobs_of(options);
  request.folder = options.folder;
  request.netcdf = options.netcdf;
  return request;
}

/// The names of what is in the folder now.
std::vector<std::string> written_files(const SpecRun& run, const Options& options) {
  std::vector<std::string> files{"report.json", "report.html"};
  for (const EngineRun& engine : run.report().members.front().result.engines) {
    if (engine.trajectory.samples.empty()) continue;
    files.push_back(engine.name + ".csv");
    if (options.netcdf) files.push_back(engine.name + ".nc");
  }
  if (run.members() == 2) files.emplace_back("0001/");
  if (run.members() > 2) files.push_back(fmt::format("0001/ to {:04}/", run.members() - 1));
  return files;
}

/// Files first: a reader of the report who leaves early must not cost the results.
int deliver(const SpecRun& run, const Options& options) {
  const int written = settle(run.error());
  if (written == kExitDone && !options.folder.empty())
    tell_written(written_files(run, options), options);
  if (!prints_report(options)) return written;
  const int printed = print(run.text(wants_colour(STDOUT_FILENO)));
  return written != kExitDone ? written : printed;
}

int exit_code(const SpecRun& run) {
  if (const int interrupted = interrupt_exit_code(); interrupted != 0) return interrupted;
  for (const std::string& failure : run.failures()) complain(failure);
  return run.exit_code();
}

int simulate(CompiledSpec compiled, const Options& options, RunRequest request) {
  const StudyPlan* const study = compiled.spec.study();
  ProgressBar bar(stderr, study != nullptr ? 0.0 : compiled.bundle.model.simulation.duration);
  watch(request.options, options, bar);
  if (request.options.progress)
    request.finished = [&bar, plan = study](std::size_t index, const ReportedMember& member) {
      bar.leave(member_line(index, member, *plan));
    };
  const SpecRun run = fly(std::move(compiled), request);
  bar.clear();
  if (run.empty()) return exit_code(run);  // interrupted before the first
  const int delivered = deliver(run, options);
  return delivered != kExitDone ? delivered : exit_code(run);
}

/// Whether memory holds what this run keeps, said now. @return the exit code
int check_kept(const CompiledSpec& compiled, const RunRequest& request, const Options& options) {
  Diagnostics diagnostics;
  if (check_memory(compiled, request, diagnostics)) return kExitDone;
  const int printed = print_diagnostics(diagnostics, options);
  return printed != kExitDone ? printed : kExitFindings;
}

/// What of a campaign the two engines fly is the campaign's to say, unless a flag does.
std::optional<CampaignRequest> campaign_of(const Options& options, const RunRequest& run) {
  CampaignRequest request;
  request.options = run.options;
  request.jobs = run.jobs;
  request.folder = run.folder;
  request.netcdf = run.netcdf;
  if (options.engine == "both") request.twins = CampaignRequest::Twins::kAll;
  if (options.engine == kBsmKey) request.twins = CampaignRequest::Twins::kNone;
  if (options.engine == kMujocoKey) return std::nullopt;
  return request;
}

int campaign(const CompiledSpec& compiled, const Options& options, const RunRequest& run) {
  const std::optional<CampaignRequest> request = campaign_of(options, run);
  if (!request)
    return report_usage("scsim", "`--engine mujoco`: members of a campaign fly in bsm",
                        "`--engine both` lets all of them fly in both engines");
  if (const int code = settle(try_files(campaign_paths(options.folder))); code != kExitDone)
    return code;
  return fly_campaign_command(compiled, options, options.campaign, *request);
}

int compile_and_simulate(const Options& options) {
  std::optional<CompiledSpec> compiled;
  RunRequest request = request_of(options);
  if (const int code = compile_spec(options, request.wanted(), compiled); code != kExitDone)
    return code;
  if (compiled->spec.campaign() != nullptr) return campaign(*compiled, options, request);
  if (const std::string flag = options.campaign.given(); !flag.empty())
    return report_usage("scsim", fmt::format("`{}` is of a campaign, and this spec has none", flag),
                        "leave it out, or see docs/campaigns.md");
  if (const int code = check_kept(*compiled, request, options); code != kExitDone) return code;
  if (const int code = settle(try_files(first_paths(options.folder))); code != kExitDone)
    return code;
  if (const int code = settle(check_disk(*compiled, request)); code != kExitDone) return code;
  return simulate(*std::move(compiled), options, std::move(request));
}

/// A word before all flags that is nearly a command and no file.
bool is_misspelt_command(const std::string& word) {
  return !word.starts_with('-') && !nearest(word, {kAttribute, kCompare, kMerge}).empty() &&
         !std::filesystem::exists(word);
}

int parse_and_run(int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  if (first == kAttribute) return attribute_command(argc - 1, argv + 1);
  if (first == kCompare) return compare_command(argc - 1, argv + 1);
  if (first == kMerge) return merge_command(argc - 1, argv + 1);
  if (is_misspelt_command(first))
    return report_usage(
        "scsim", fmt::format("unknown command {}", in_backticks(first)),
        fmt::format("did you mean `{}`?", nearest(first, {kAttribute, kCompare, kMerge})));
  CommandLine line{"Runs a spacecraft spec in both engines and says whether they agree.", "scsim"};
  Options options;
  describe(line, options);
  if (const std::optional<int> code = line.parse(argc, argv)) return *code;
  if (const std::optional<int> code = settle_flags("scsim", options)) return *code;
  if (options.netcdf && !has_netcdf())
    return report_usage("scsim", "`--netcdf` asks for what is missing: this build has no netCDF",
                        "leave it out, or configure the build with `-DTWINCRAFT_NETCDF=ON`");
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
