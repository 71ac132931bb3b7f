// Flags to records to a table to an exit code. Tested by tests/agreement/campaign_test.cpp.
#include "tools/programs/campaign.h"

#include <fmt/format.h>

#include "runtime/delivery/campaign_files.h"
#include "runtime/report/campaign_table.h"
#include "tools/programs/interrupt.h"

namespace twincraft {
namespace {

const char* const kShard = "--shard";

/// What a person sees of members that are not in a table yet.
std::string shard_line(const CampaignResult& result) {
  std::string line = fmt::format("{} members flown", result.flown);
  if (result.resumed > 0) line += fmt::format(", {} were there", result.resumed);
  return line + "\n";
}

/// Members fly side by side, for which another set may be the faster one.
void watch_campaign(RunOptions& run, const CommonOptions& options, ProgressBar& bar) {
  watch(run, options, bar);
  if (options.isa == "auto") run.instructions = bsm::choose(bsm::Use::kBatch);
}

int exit_code(const CampaignResult& result) {
  if (const int interrupted = interrupt_exit_code(); interrupted != 0) return interrupted;
  return result.exit_code();
}

std::vector<std::string> written_files(const CampaignReport& report) {
  std::vector<std::string> files;
  for (const std::string& path : campaign_paths("."))
    files.push_back(std::filesystem::path(path).filename().string());
  for (const std::size_t member : report.kept) files.push_back(member_folder(member) + "/");
  return files;
}

int deliver(const CampaignResult& result, const CommonOptions& options) {
  for (const std::string& remark : result.remarks) complain(remark);
  if (const int code = settle(result.error); code != kExitDone) return code;
  if (result.report && !options.folder.empty())
    tell_written(written_files(*result.report), options);
  if (!prints_report(options)) return exit_code(result);
  const int printed = print(result.report ? campaign_table(*result.report) : shard_line(result));
  return printed != kExitDone ? printed : exit_code(result);
}

}  // namespace

std::string CampaignOptions::given() const {
  if (!shard.empty()) return kShard;
  if (resume) return "--resume";
  return stop_on_failure ? "--stop-on-failure" : "";
}

void describe_campaign(CommandLine& line, CampaignOptions& options) {
  line.add_text(kShard, options.shard, "I/N",
                "of a campaign: fly part I of N; scsim merge joins them");
  line.add_switch("--resume", options.resume, "of a campaign: keep members that DIR has");
  line.add_switch("--stop-on-failure", options.stop_on_failure,
                  "of a campaign: begin no member after one that failed");
  line.require(kShard, "--output");
  line.require("--resume", "--output");
}

int fly_campaign_command(const CompiledSpec& compiled, const CommonOptions& common,
                         const CampaignOptions& options, CampaignRequest request) {
  std::string why;
  if (!options.shard.empty()) request.shard = parse_shard(options.shard, why);
  if (!why.empty())
    return report_usage("scsim", fmt::format("`--shard`: {}", why),
                        "for example `--shard 2/8`, the second of eight");
  request.resume = options.resume;
  request.stops_on_failure = options.stop_on_failure;
  ProgressBar bar(stderr);
  watch_campaign(request.options, common, bar);
  const CampaignResult result = fly_campaign(compiled, request);
  bar.clear();
  return deliver(result, common);
}

int merge_command(int argc, char** argv) {
  CommandLine line{"Makes one table and report of the shards of a campaign.", "scsim merge"};
  CommonOptions options;
  bool netcdf = false;
  line.add_text("DIR", options.folder, "DIR", "folder that the shards wrote into");
  line.add_switch("--netcdf", netcdf, "also write kept trajectories as netCDF-4");
  describe_instructions(line, options);
  describe_jobs(line, options, "kept members at a time (default: all cores)");
  describe_talk(line, options);
  line.set_column(28);
  line.add_footer(
      "Members that are missing are left out and named; the rest is written all the same.\n\n"
      "Exit: as scsim's; 1 when members are missing, 3 when DIR holds no campaign.\n\n"
      "Example: scsim merge out");
  if (const std::optional<int> code = line.parse(argc, argv)) return *code;
  if (!options.explain.empty()) return explain_code("scsim merge", options.explain);
  if (options.folder.empty())
    return report_usage("scsim merge", "DIR is missing", "for example `scsim merge out`");
  Diagnostics diagnostics;
  Compilation made = compile_shards(options.folder, wanted_by_run(true), diagnostics);
  if (!made.io_error.empty()) return settle(made.io_error);
  if (const int code = print_diagnostics(diagnostics, options); code != kExitDone) return code;
  if (!made.compiled) return made.exit_code(diagnostics);
  CampaignRequest request;
  request.folder = options.folder;
  request.jobs = jobs_of(options);
  request.netcdf = netcdf;
  ProgressBar bar(stderr);
  watch_campaign(request.options, options, bar);
  const CampaignResult result = merge_campaign(*made.compiled, request);
  bar.clear();
  return deliver(result, options);
}

}  // namespace twincraft
