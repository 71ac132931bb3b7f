// See campaign_run.h.
#include "runtime/delivery/campaign_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "compiler/files/output.h"
#include "compiler/ir/digest.h"
#include "runtime/campaign/run_campaign.h"
#include "runtime/delivery/campaign_files.h"
#include "runtime/delivery/campaign_kept.h"
#include "runtime/delivery/spec_run.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;

/// The spec, but for the number of its members: a campaign may go on with more, unless others would
/// then be drawn. Empty where no file is to tell it.
std::string digest_of(const Bundle& bundle, Sampling sampling) {
  if (bundle.resolved_json.empty()) return {};
  nlohmann::ordered_json spec = nlohmann::ordered_json::parse(bundle.resolved_json);
  if (sampling != Sampling::kLatinHypercube) spec["campaign"].erase("members");
  return sha256(spec.dump());
}

RecordsHeader header_of(const CompiledSpec& compiled, const RunOptions& options) {
  const CampaignPlan& plan = *compiled.spec.campaign();
  RecordsHeader header{.name = compiled.bundle.model.name,
                       .spec_sha256 = digest_of(compiled.bundle, plan.sampling),
                       .instructions = std::string(name_of(options.instructions.set)),
                       .drawn = plan.drawn,
                       .outputs = {}};
  for (const OutputPlan& output : plan.outputs) header.outputs.push_back(column_of(output));
  return header;
}

std::size_t twin_every(const CampaignPlan& plan, CampaignRequest::Twins twins) {
  switch (twins) {
    case CampaignRequest::Twins::kPlanned:
      return plan.twin_every;
    case CampaignRequest::Twins::kAll:
      return 1;
    case CampaignRequest::Twins::kNone:
      break;
  }
  return 0;
}

/// The worse one comes first.
Verdict worse(Verdict a, Verdict b) {
  constexpr std::array kOrder{Verdict::kInterrupted, Verdict::kFailed,    Verdict::kUnresolved,
                              Verdict::kDisagree,    Verdict::kNotJudged, Verdict::kAgree};
  return std::min(a, b, [&](Verdict x, Verdict y) {
    return std::ranges::find(kOrder, x) < std::ranges::find(kOrder, y);
  });
}

std::vector<bool> independent(const CampaignPlan& plan) {
  std::vector<bool> all;
  for (const DrawnNumber& number : plan.drawn) all.push_back(number.is_independent);
  return all;
}

std::vector<std::size_t> members_to_fly(const Shard& shard, const std::vector<bool>& done) {
  std::vector<std::size_t> members;
  for (std::size_t member = shard.index - 1; member < done.size(); member += shard.count)
    if (!done[member]) members.push_back(member);
  return members;
}

/// Takes the records as they come. @return false: it can take no more
using TakeRecord = std::function<bool(const MemberRecord& record)>;

/// A campaign on its way.
class Campaign {
 public:
  Campaign(const CompiledSpec& compiled, const CampaignRequest& request)
      : compiled_(compiled),
        request_(request),
        plan_(*compiled.spec.campaign()),
        header_(header_of(compiled, request.options)) {}

  CampaignResult fly() {
    if (request_.folder.empty()) {
      CampaignTable table(header_);
      fly_members(members_to_fly({}, std::vector<bool>(plan_.members)),
                  [&table](const MemberRecord& record) {
                    table.add(record);
                    return true;
                  });
      settle(std::move(table));
    } else {
      fly_into_folder();
    }
    return std::move(result_);
  }

  /// Of what the folder holds.
  CampaignResult merge() {
    std::optional<MergedCampaign> merged = CampaignShards(request_.folder).merge(result_.error);
    if (merged) finish(*std::move(merged));
    return std::move(result_);
  }

 private:
  bool failed() const { return !result_.error.empty(); }

  void fly_into_folder() {
    const CampaignShards shards(request_.folder);
    fly_shard(shards, request_.shard.value_or(Shard{}));
    if (failed()) return;
    if (request_.shard) return conclude_shard();
    std::optional<MergedCampaign> merged = shards.merge(result_.error);
    if (merged) finish(*std::move(merged));
  }

  /// Those of its members that its file does not have.
  void fly_shard(const CampaignShards& shards, const Shard& own) {
    CampaignShards::Found found{.done = std::vector<bool>(plan_.members)};
    if (request_.resume)
      found = shards.find(header_, own, plan_.members, [this](const MemberRecord& record) {
        note(record);
        ++result_.resumed;
      });
    result_.error = found.error;
    if (failed()) return;
    const std::optional<MergedCampaign> elsewhere =
        merge_records(header_, request_.records, result_.error);
    if (failed()) return;
    ShardFile file(shards.path_of(own), found, header_, plan_.members);
    result_.error = file.error();
    if (failed()) return;
    if (!request_.resume && !request_.shard) shards.remove_others(own);
    result_.error = write_files({{shards.spec().string(), compiled_.bundle.text(kResolved)}});
    if (failed()) return;
    take_records(*elsewhere, found.done, file);
    fly_members(members_to_fly(own, found.done), [&file](const MemberRecord& record) {
      file.append(record);
      return file.error().empty();
    });
    result_.error = file.error();
  }

  /// What was flown elsewhere and is not there yet. @param done  by member: so are they then
  void take_records(const MergedCampaign& elsewhere, std::vector<bool>& done, ShardFile& file) {
    taken_remarks_ = elsewhere.remarks;
    const std::span<const std::size_t> members = elsewhere.table.members();
    for (std::size_t row = 0; row < members.size(); ++row) {
      if (members[row] >= done.size() || done[members[row]]) continue;
      done[members[row]] = true;
      const MemberRecord record = elsewhere.table.record(row);
      file.append(record);
      note(record);
      ++result_.resumed;
    }
  }

  void fly_members(std::vector<std::size_t> members, const TakeRecord& take) {
    bool enough = false;
    CampaignRun run;
    run.plan = plan_;
    run.plan.twin_every = twin_every(plan_, request_.twins);
    run.members = std::move(members);
    run.jobs = request_.jobs;
    run.drawn = [this](std::size_t member) { return compiled_.spec.drawn(member); };
    run.compile = [this](std::size_t member, bool both) {
      return compile(member, both ? wanted_by_run(false) : Wanted{});
    };
    run.finished = [&](const MemberRecord& record) {
      const bool takes_more = take(record);
      note(record);
      ++result_.flown;
      enough = !takes_more || (request_.stops_on_failure && record.verdict == Verdict::kFailed);
    };
    run.enough = [&enough] { return enough; };
    run_campaign(run, request_.options);
  }

  MemberSpec compile(std::size_t member, const Wanted& wanted) const {
    return compile_member([&](Diagnostics& diagnostics) {
      return compiled_.spec.campaign_member(member, wanted, diagnostics);
    });
  }

  void settle(CampaignTable table) {
    result_.error = table.settle(plan_.members);
    if (failed() || table.rows() == 0) return conclude_shard();
    std::vector<MemberRange> missing = table.missing(plan_.members);
    finish({std::move(table), plan_.members, std::move(missing), {}});
  }

  /// What a record says of the campaign.
  void note(const MemberRecord& record) {
    result_.verdict = worse(result_.verdict, record.verdict);
    result_.breaks_requirements = result_.breaks_requirements || breaks(record);
  }
  bool breaks(const MemberRecord& record) const {
    return record.verdict != Verdict::kFailed &&
           !broken_requirements(header_.outputs, record.outputs).empty();
  }

  void conclude_shard() {
    result_.is_interrupted = request_.options.stopped();
    if (result_.is_interrupted) result_.verdict = Verdict::kInterrupted;
  }

  /// From records to everything that is said of them.
  void finish(MergedCampaign merged) {
    merged.remarks.insert(merged.remarks.begin(), taken_remarks_.begin(), taken_remarks_.end());
    result_.remarks = merged.remarks;
    OutputFolder folder(request_.folder, OutputFolder::First::kApart);
    const std::vector<std::size_t> kept = members_to_keep(plan_, merged.table);
    if (request_.twins != CampaignRequest::Twins::kNone)
      result_.error = keep_members(kept, keep_request(folder), merged.table);
    if (failed()) return;
    CampaignReport report = report_of(std::move(merged), kept);
    judge(report);
    if (!request_.folder.empty()) result_.error = write_campaign(report, folder);
    result_.report = std::move(report);
  }

  KeepRequest keep_request(OutputFolder& folder) const {
    KeepRequest keep;
    keep.compile = [this](std::size_t member) {
      return compile(member, wanted_by_run(!request_.folder.empty()));
    };
    keep.options = request_.options;
    keep.jobs = request_.jobs;
    keep.folder = request_.folder.empty() ? nullptr : &folder;
    keep.netcdf = request_.netcdf;
    keep.provenance = provenance_of(request_.options, request_.program);
    return keep;
  }

  CampaignReport report_of(MergedCampaign merged, const std::vector<std::size_t>& kept) const {
    const Bundle& nominal = compiled_.bundle;
    CampaignFindings findings = find_all(merged, plan_, independent(plan_));
    CampaignReport report{
        .campaign = std::move(merged), .plan = plan_, .findings = std::move(findings)};
    report.provenance = provenance_of(request_.options, request_.program);
    report.description = nominal.model.description;
    report.spec_file = nominal.spec_file;
    report.spec_sha256 = nominal.spec_sha256;
    report.degrees_of_freedom = nominal.model.degrees_of_freedom();
    report.kept = kept;
    report.settings = [spec = compiled_.spec, changes = nominal.settings](std::size_t member) {
      std::vector<std::string> settings;
      for (const Setting& change : changes)
        settings.push_back(fmt::format("{}={}", change.path, change.text));
      for (std::string& setting : spec.campaign_settings(member))
        settings.push_back(std::move(setting));
      return settings;
    };
    return report;
  }

  void judge(CampaignReport& report) {
    const CampaignTable& table = report.campaign.table;
    result_.is_interrupted = request_.options.stopped();
    report.complete = report.campaign.missing.empty() && !result_.is_interrupted;
    Verdict verdict = result_.is_interrupted ? Verdict::kInterrupted : Verdict::kAgree;
    for (std::size_t row = 0; row < table.rows(); ++row)
      verdict = worse(verdict, table.verdict(row));
    for (const OutputFindings& output : report.findings.outputs) {
      const PassRate& flown = output.summary.flown;
      result_.breaks_requirements = result_.breaks_requirements || flown.passed < flown.of;
    }
    report.verdict = result_.verdict = verdict;
  }

  const CompiledSpec& compiled_;
  const CampaignRequest& request_;
  const CampaignPlan& plan_;
  RecordsHeader header_;
  std::vector<std::string> taken_remarks_;  // on records that were flown elsewhere
  CampaignResult result_;
};

}  // namespace

int CampaignResult::exit_code() const {
  if (!error.empty()) return kExitInputOutput;
  if (is_interrupted) return kExitInterrupted;
  if (verdict == Verdict::kFailed) return kExitFailure;
  const bool finds = verdict == Verdict::kDisagree || verdict == Verdict::kUnresolved ||
                     breaks_requirements || (report && !report->complete);
  return finds ? kExitFindings : kExitDone;
}

CampaignResult fly_campaign(const CompiledSpec& compiled, const CampaignRequest& request) {
  return Campaign(compiled, request).fly();
}

Compilation compile_shards(const std::string& folder, const Wanted& wanted,
                           Diagnostics& diagnostics) {
  const CampaignShards shards(folder);
  const std::size_t members = shards.members();
  if (members == 0)
    return {.io_error = fmt::format("{} holds no results of a campaign", in_backticks(folder))};
  CompileRequest request;
  request.file = shards.spec().string();
  request.overrides = {fmt::format("campaign.members={}", members)};
  return compile_spec(request, wanted, diagnostics);
}

CampaignResult merge_campaign(const CompiledSpec& compiled, const CampaignRequest& request) {
  return Campaign(compiled, request).merge();
}

}  // namespace twincraft
