// One function per object of the format, in the order of the file.
#include "runtime/report/campaign_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/report/json.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

// Beyond these a list names no more: the rows of campaign.csv do.
constexpr std::size_t kMostRanges = 1000;
constexpr std::size_t kMostMembers = 1000;
constexpr std::size_t kMostReasons = 100;

template <typename T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

template <typename T>
std::span<const T> first_of(const std::vector<T>& all, std::size_t most) {
  return std::span(all).first(std::min(all.size(), most));
}

Json spec_json(const CampaignReport& report) {
  return {{"name", report.campaign.table.header().name},
          {"file", report.spec_file},
          {"sha256", report.spec_sha256},
          {"degrees_of_freedom", report.degrees_of_freedom}};
}

Json missing_json(const std::vector<MemberRange>& missing) {
  std::size_t count = 0;
  for (const auto& [first, last] : missing) count += last - first + 1;
  Json ranges = Json::array();
  for (const auto& [first, last] : first_of(missing, kMostRanges)) ranges.push_back({first, last});
  return {{"count", count}, {"ranges", std::move(ranges)}};
}

Json drawn_json(const std::vector<DrawnNumber>& drawn) {
  Json json = Json::array();
  for (const DrawnNumber& one : drawn)
    json.push_back({{"name", one.name},
                    {"unit", one.unit},
                    {"distribution", one.distribution},
                    {"nominal", one.nominal}});
  return json;
}

Json interval_json(const statistics::Interval& interval) {
  return Json::array({interval.lower, interval.upper});
}

/// Of no members there is no rate.
Json pass_json(const PassRate& pass) {
  return {{"passed", pass.passed},
          {"of", pass.of},
          {"rate", pass.of > 0 ? Json(pass.rate()) : Json(nullptr)},
          {"interval", interval_json(pass.interval)}};
}

Json driver_json(const Driver& driver, const std::vector<DrawnNumber>& drawn) {
  Json json{{"name", drawn[driver.drawn].name},
            {"rank_correlation", driver.rank ? Json(driver.rank->coefficient) : Json(nullptr)},
            {"p_value", driver.rank ? Json(driver.rank->p_value) : Json(nullptr)},
            {"sobol_first", nullptr}};
  if (const auto& index = driver.sobol_first)
    json["sobol_first"] = {{"value", index->value},
                           {"interval", Json::array({index->lower, index->upper})}};
  return json;
}

Json output_json(const OutputColumn& output, const OutputFindings& found,
                 const std::vector<DrawnNumber>& drawn) {
  const OutputSummary& summary = found.summary;
  Json json{{"name", output.name},
            {"unit", output.unit},
            {"meaning", output.meaning},
            {"count", summary.count},
            {"min", summary.min},
            {"median", summary.median},
            {"p95", summary.p95},
            {"p95_bounds",
             Json::array({or_null(summary.p95_bounds.lower), or_null(summary.p95_bounds.upper)})},
            {"max", summary.max},
            {"tolerance_95_95", or_null(summary.tolerance_upper)},
            {"tolerance_95_95_lower", or_null(summary.tolerance_lower)},
            {"requirement", nullptr},
            {"pass", nullptr}};
  if (output.is_required()) {
    json["requirement"] = {{"below", or_null(output.below)}, {"above", or_null(output.above)}};
    json["pass"] = {{"flown", pass_json(summary.flown)}, {"all", pass_json(summary.all)}};
  }
  json["drivers"] = Json::array();
  for (const Driver& driver : found.drivers.drivers)
    json["drivers"].push_back(driver_json(driver, drawn));
  if (!found.drivers.no_sobol.empty()) json["no_sobol"] = found.drivers.no_sobol;
  return json;
}

Json outputs_json(const CampaignReport& report) {
  const RecordsHeader& header = report.campaign.table.header();
  Json json = Json::array();
  for (std::size_t i = 0; i < header.outputs.size(); ++i)
    json.push_back(output_json(header.outputs[i], report.findings.outputs[i], header.drawn));
  return json;
}

Json twins_json(const TwinFindings& twins, const std::vector<DrawnNumber>& drawn) {
  Json json{{"flown", twins.count.flown},
            {"agree", twins.count.agree},
            {"disagree", twins.count.disagree},
            {"interval", interval_json(twins.interval)},
            {"members", first_of(twins.disagreeing, kMostMembers)},
            {"driver", nullptr}};
  if (const auto& driver = twins.driver)
    json["driver"] = {{"name", drawn[driver->drawn].name},
                      {"larger_where_they_disagree", driver->larger},
                      {"p_value", driver->p_value}};
  return json;
}

Json failures_json(const std::vector<ReasonCount>& failures) {
  Json json = Json::array();
  for (const ReasonCount& one : first_of(failures, kMostReasons))
    json.push_back({{"reason", one.reason}, {"count", one.count}, {"first", one.first}});
  return json;
}

Json unresolved_json(const UnresolvedMembers& unresolved) {
  return {{"count", unresolved.members.size()},
          {"members", first_of(unresolved.members, kMostMembers)},
          {"reason", unresolved.reason}};
}

/// Null where nobody knows it.
Json command_json(const CampaignReport& report, std::size_t member) {
  const std::string command = reproducing_command(report, member);
  return command.empty() ? Json(nullptr) : Json(command);
}

Json worst_json(const CampaignReport& report) {
  const std::vector<OutputColumn>& outputs = report.campaign.table.header().outputs;
  Json json = Json::array();
  for (std::size_t i = 0; i < outputs.size(); ++i)
    for (const WorstMember& one : report.findings.outputs[i].worst)
      json.push_back({{"member", one.member},
                      {"output", outputs[i].name},
                      {"value", one.value},
                      {"pass", outputs[i].is_required() ? Json(one.holds) : Json(nullptr)},
                      {"command", command_json(report, one.member)}});
  return json;
}

Json kept_json(const CampaignReport& report) {
  Json json = Json::array();
  for (const std::size_t member : report.kept)
    json.push_back({{"member", member},
                    {"folder", member_folder(member)},
                    {"command", command_json(report, member)}});
  return json;
}

Json campaign_value(const CampaignReport& report) {
  const RecordsHeader& header = report.campaign.table.header();
  return {{"members", report.campaign.members},
          {"flown", report.findings.flown},
          {"missing", missing_json(report.campaign.missing)},
          {"seed", report.plan.seed},
          {"sampling", sampling_name(report.plan.sampling)},
          {"drawn", drawn_json(header.drawn)},
          {"outputs", outputs_json(report)},
          {"twins", twins_json(report.findings.twins, header.drawn)},
          {"failures", failures_json(report.findings.failures)},
          {"unresolved", unresolved_json(report.findings.unresolved)},
          {"worst", worst_json(report)},
          {"kept", kept_json(report)},
          {"remarks", report.campaign.remarks}};
}

}  // namespace

Json campaign_report_value(const CampaignReport& report) {
  return {{"format", "twincraft-report/1"},
          {"complete", report.complete},
          {"verdict", verdict_name(report.verdict)},
          {"spec", spec_json(report)},
          {"provenance", provenance_json(report.provenance)},
          {"campaign", campaign_value(report)}};
}

std::string campaign_json(const CampaignReport& report) {
  return campaign_report_value(report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace twincraft
