// The C interface: campaigns. See include/twincraft.h.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <span>

#include "compiler/diag/diagnostics.h"
#include "runtime/api/run_handle.h"
#include "runtime/bsm/processor.h"
#include "runtime/campaign/findings.h"
#include "runtime/compare/verdict.h"
#include "runtime/delivery/campaign_files.h"
#include "runtime/report/campaign_csv.h"
#include "runtime/report/campaign_json.h"
#include "runtime/report/campaign_table.h"

namespace twincraft::api {
namespace {

constexpr tc_campaign_options kDefaults{sizeof(tc_campaign_options),
                                        TC_TWINS_PLANNED,
                                        0,
                                        nullptr,
                                        nullptr,
                                        0,
                                        0,
                                        0,
                                        nullptr,
                                        nullptr,
                                        0,
                                        nullptr,
                                        nullptr};

/// Members fly side by side, for which another set may be the faster one.
bsm::Choice instructions_of(const char* isa) {
  const std::string word = isa != nullptr ? isa : "auto";
  if (word == "auto") return bsm::choose(bsm::Use::kBatch);
  const std::optional<bsm::InstructionSet> set = bsm::instruction_set_of(word);
  if (!set) refuse(fmt::format("{} is none of auto, portable, avx2, avx512", in_backticks(word)));
  if (*set > bsm::this_processor().widest)
    refuse(fmt::format("this processor has no {}", in_backticks(word)));
  return {*set, "--isa " + word};
}

CampaignRequest::Twins twins_of(tc_twins twins) {
  switch (twins) {
    case TC_TWINS_ALL:
      return CampaignRequest::Twins::kAll;
    case TC_TWINS_NONE:
      return CampaignRequest::Twins::kNone;
    case TC_TWINS_PLANNED:
      break;
  }
  return CampaignRequest::Twins::kPlanned;
}

std::optional<Shard> shard_of(const tc_campaign_options& wanted) {
  if (wanted.shards == 0) return std::nullopt;
  std::string why;
  const std::optional<Shard> shard =
      parse_shard(fmt::format("{}/{}", wanted.shard, wanted.shards), why);
  if (!shard) refuse(why);
  return shard;
}

CampaignRequest request_of(const tc_campaign_options& wanted) {
  CampaignRequest request;
  request.options.instructions = instructions_of(wanted.isa);
  request.twins = twins_of(wanted.twins);
  request.jobs = jobs_of(wanted.jobs);
  request.shard = shard_of(wanted);
  request.resume = wanted.resume != 0;
  for (std::size_t i = 0; i < wanted.record_count; ++i)
    request.records.emplace_back(wanted.records[i], wanted.record_sizes[i]);
  return request;
}

/// Where its files go: where the caller wants them, or into a folder of the handle's own.
FlownCampaign place_of(const tc_campaign_options& wanted) {
  FlownCampaign flown;
  if (wanted.folder != nullptr) {
    if (*wanted.folder == '\0') refuse("a folder must have a name");
    flown.folder = wanted.folder;
    return flown;
  }
  flown.scratch = std::make_unique<ScratchFolder>();
  if (!flown.scratch->error().empty()) throw Fault(TC_FILE, flown.scratch->error());
  flown.folder = flown.scratch->path();
  return flown;
}

void fly_into(tc_run& handle, const tc_campaign_options& wanted) {
  attend(wanted, [&](const std::atomic<bool>& stop) {
    campaign_of(*handle.model);
    CampaignRequest request = request_of(wanted);
    FlownCampaign flown = place_of(wanted);
    request.folder = flown.folder.string();
    flown.folder = std::filesystem::absolute(flown.folder);  // the program may go elsewhere
    request.options.stop = &stop;
    flown.shard = request.shard.value_or(Shard{});
    if (std::string error = try_files(campaign_paths(request.folder)); !error.empty())
      throw Fault(TC_FILE, error);
    flown.result = fly_campaign({handle.model->spec(), handle.model->bundle()}, request);
    const CampaignResult& result = flown.result;
    if (!result.error.empty()) throw Fault(TC_FILE, result.error);
    if (result.is_interrupted && !result.report) end_interrupted();
    if (result.report) {
      handle.text = campaign_table(*result.report);
      handle.json = campaign_json(*result.report);
    }
    handle.passes = result.exit_code() == kExitDone;
    handle.verdict = verdict_name(result.verdict);
    handle.campaign = std::move(flown);
  });
}

/// Null: it is no campaign, or a shard of one, whose rows come with the others'.
const CampaignReport* report_of(const tc_run* run) {
  if (run == nullptr || !run->campaign || !run->campaign->result.report) return nullptr;
  return &*run->campaign->result.report;
}

const CampaignTable& table_of(const tc_run& run) {
  const CampaignReport* report = report_of(&run);
  if (report == nullptr) refuse("there is no table of members");
  return report->campaign.table;
}

/// A column of numbers: what was drawn, outputs, seconds.
struct Column {
  const char *name, *unit;
  std::span<const double> values;
};

std::size_t columns_of(const CampaignTable& table) {
  return table.header().drawn.size() + table.header().outputs.size() + 1;
}

/// @pre column < columns_of(table)
Column column_of(const CampaignTable& table, std::size_t column) {
  const RecordsHeader& header = table.header();
  if (column < header.drawn.size()) {
    const DrawnNumber& drawn = header.drawn[column];
    return {drawn.name.c_str(), drawn.unit.c_str(), table.drawn(column)};
  }
  column -= header.drawn.size();
  if (column == header.outputs.size()) return {"seconds", "s", table.seconds()};
  const OutputColumn& output = header.outputs[column];
  return {output.name.c_str(), output.unit.c_str(), table.output(column)};
}

/// The output whose worst members are asked for: by default the one that members are kept by, else
/// the first that something is required of, else the first.
std::size_t output_of(const CampaignReport& report, const char* by) {
  const std::vector<OutputColumn>& outputs = report.campaign.table.header().outputs;
  if (outputs.empty()) refuse("the campaign has no outputs");
  const auto place = [&](auto found) { return static_cast<std::size_t>(found - outputs.begin()); };
  const std::string name = by != nullptr ? by : report.plan.keep_by;
  const auto named = std::ranges::find(outputs, name, &OutputColumn::name);
  if (named != outputs.end()) return place(named);
  if (by == nullptr) {
    const auto required = std::ranges::find_if(outputs, &OutputColumn::is_required);
    return required != outputs.end() ? place(required) : 0;
  }
  std::vector<std::string> names;
  for (const OutputColumn& output : outputs) names.push_back(output.name);
  const std::string near = nearest(name, names);
  refuse(fmt::format("unknown output {}{}", in_backticks(name),
                     near.empty() ? "" : fmt::format("; did you mean {}?", in_backticks(near))));
}

std::string csv_of(const CampaignTable& table) {
  const CampaignCsv csv(table);
  std::string text = csv.header();
  for (std::size_t row = 0; row < table.rows(); ++row) csv.append(row, text);
  return text;
}

std::string records_of(const FlownCampaign& flown) {
  const std::filesystem::path path = CampaignShards(flown.folder).path_of(flown.shard);
  std::ifstream in(path, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(in), {});
  if (!in) throw Fault(TC_FILE, fmt::format("cannot read {}", in_backticks(path.string())));
  return bytes;
}

}  // namespace

std::string save_campaign(const FlownCampaign& flown, const std::string& folder) {
  if (!flown.result.report)
    refuse("a shard has no report: its records are merged with the others'");
  return twincraft::save_campaign(*flown.result.report, flown.folder.string(), folder);
}

}  // namespace twincraft::api

using namespace twincraft;
using namespace twincraft::api;

extern "C" {

tc_status tc_model_campaign(const tc_model* model, const tc_campaign_options* options,
                            tc_run** campaign) {
  return make_run(model, campaign,
                  [options](tc_run& h) { fly_into(h, options ? *options : kDefaults); });
}

int tc_campaign_exit_code(const tc_run* campaign) {
  return campaign == nullptr || !campaign->campaign ? 0 : campaign->campaign->result.exit_code();
}

size_t tc_campaign_rows(const tc_run* campaign) {
  const CampaignReport* report = report_of(campaign);
  return report == nullptr ? 0 : report->campaign.table.rows();
}

size_t tc_campaign_columns(const tc_run* campaign) {
  const CampaignReport* report = report_of(campaign);
  return report == nullptr ? 0 : columns_of(report->campaign.table);
}

const char* tc_campaign_column_name(const tc_run* campaign, size_t column) {
  if (column >= tc_campaign_columns(campaign)) return nullptr;
  return column_of(report_of(campaign)->campaign.table, column).name;
}

const char* tc_campaign_column_unit(const tc_run* campaign, size_t column) {
  if (column >= tc_campaign_columns(campaign)) return nullptr;
  return column_of(report_of(campaign)->campaign.table, column).unit;
}

tc_status tc_campaign_read(tc_run* campaign, size_t column, double* values, size_t size) {
  return inside(campaign, Use::kAsks, [&] {
    const CampaignTable& table = table_of(*campaign);
    if (column >= columns_of(table)) refuse(fmt::format("there is no column {}", column));
    check_size(size, table.rows(), "a column");
    std::ranges::copy(column_of(table, column).values, values);
  });
}

tc_status tc_campaign_row(tc_run* campaign, size_t row, size_t* member, const char** verdict,
                          const char** reason) {
  return inside(campaign, Use::kAsks, [&] {
    const CampaignTable& table = table_of(*campaign);
    if (row >= table.rows()) refuse(fmt::format("there is no row {}", row));
    if (member != nullptr) *member = table.members()[row];
    if (verdict != nullptr) *verdict = verdict_name(table.verdict(row)).data();
    // Of a text of the table's own, or of none.
    if (reason != nullptr) *reason = table.reason(row).empty() ? "" : table.reason(row).data();
  });
}

tc_status tc_campaign_worst(tc_run* campaign, const char* by, size_t* members, size_t capacity,
                            size_t* count) {
  return inside(campaign, Use::kAsks, [&] {
    const CampaignTable& table = table_of(*campaign);
    const std::size_t output = output_of(*report_of(campaign), by);
    const std::vector<WorstMember> worst = worst_members(table, output, capacity);
    if (members != nullptr) std::ranges::transform(worst, members, &WorstMember::member);
    if (count != nullptr) *count = worst.size();
  });
}

const char* tc_campaign_text(tc_run* campaign, tc_campaign_texts which, size_t* length) {
  static const std::string kNothing;
  const std::string* text = &kNothing;
  inside(campaign, Use::kAsks, [&] {
    if (!campaign->campaign) return;
    FlownCampaign& flown = *campaign->campaign;
    switch (which) {
      case TC_CAMPAIGN_HEADER:
        text = &(flown.header = header_json(table_of(*campaign).header()));
        break;
      case TC_CAMPAIGN_CSV:
        text = &(flown.csv = csv_of(table_of(*campaign)));
        break;
      case TC_CAMPAIGN_RECORDS:
        text = &(flown.records = records_of(flown));
        break;
    }
  });
  if (length != nullptr) *length = text->size();
  return text->c_str();
}

}  // extern "C"
