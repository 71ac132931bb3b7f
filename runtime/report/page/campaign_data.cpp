#include "runtime/report/page/campaign_data.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "runtime/report/campaign_json.h"
#include "runtime/report/page/base64.h"
#include "runtime/report/page/inline_json.h"
#include "runtime/statistics/sample.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostSteps = 400;       // of a distribution
constexpr std::size_t kDriversDrawn = 3;      // of each output: the strongest
constexpr std::size_t kMostDots = 2000;       // of a scatter
constexpr std::size_t kFewestDots = 200;      // the same
constexpr std::size_t kMostNumbers = 60'000;  // of all scatters: 640 kB

/// At most `most` of some rows, evenly.
std::vector<std::size_t> thinned(const std::vector<std::size_t>& rows, std::size_t most) {
  if (rows.size() <= most) return rows;
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(rows[i * rows.size() / most]);
  return some;
}

/// Those that say why (broken, stopped, failed, refused) or not.
std::vector<std::size_t> rows_with_reason(const CampaignTable& table, bool with_reason) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (table.reason(row).empty() != with_reason) rows.push_back(row);
  return rows;
}

/// Rare members are what is looked for, so members with a reason have a third of the room, and what
/// the others leave of theirs.
std::vector<std::size_t> drawn_rows(const CampaignTable& table, std::size_t most) {
  const std::vector<std::size_t> plain = rows_with_reason(table, false);
  const std::vector<std::size_t> marked = rows_with_reason(table, true);
  const std::size_t room = most / 3;
  const std::size_t rest = most - std::min(room, marked.size());
  const std::vector<std::size_t> some = thinned(plain, rest);
  std::vector<std::size_t> rows = thinned(marked, most - some.size());
  rows.insert(rows.end(), some.begin(), some.end());
  std::ranges::sort(rows);
  return rows;
}

/// Drawn numbers that some output is drawn over: their columns.
std::set<std::size_t> drawn_columns(const CampaignFindings& findings) {
  std::set<std::size_t> columns;
  for (const OutputFindings& one : findings.outputs)
    for (std::size_t i = 0; i < std::min(kDriversDrawn, one.drivers.drivers.size()); ++i)
      columns.insert(one.drivers.drivers[i].drawn);
  return columns;
}

std::string column_text(std::span<const double> column, const std::vector<std::size_t>& rows) {
  std::vector<double> values;
  for (const std::size_t row : rows) values.push_back(column[row]);
  return base64(values);
}

/// Members and their numbers, column by column; outputs of members that were not flown do not
/// count.
Json scatter_json(const CampaignReport& report) {
  const CampaignTable& table = report.campaign.table;
  const std::set<std::size_t> drawn = drawn_columns(report.findings);
  const std::size_t columns = 2 + drawn.size() + report.findings.outputs.size();
  const std::vector<std::size_t> rows =
      drawn_rows(table, std::clamp(kMostNumbers / columns, kFewestDots, kMostDots));
  std::vector<double> members, flown;
  for (const std::size_t row : rows) {
    members.push_back(static_cast<double>(table.members()[row]));
    flown.push_back(table.is_flown(row) ? 1.0 : 0.0);
  }
  Json json{{"of", table.rows()},
            {"members", base64(members)},
            {"flown", base64(flown)},
            {"drawn", Json::object()},
            {"outputs", Json::array()}};
  for (const std::size_t i : drawn)
    json["drawn"][table.header().drawn[i].name] = column_text(table.drawn(i), rows);
  for (std::size_t i = 0; i < report.findings.outputs.size(); ++i)
    json["outputs"].push_back(column_text(table.output(i), rows));
  return json;
}

std::vector<double> flown_values(const CampaignTable& table, std::size_t output) {
  std::vector<double> values;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (table.is_flown(row)) values.push_back(table.output(output)[row]);
  return values;
}

Json distributions_json(const CampaignTable& table) {
  Json json = Json::array();
  for (std::size_t i = 0; i < table.header().outputs.size(); ++i) {
    std::vector<double> values, shares;
    for (const statistics::Step& step :
         statistics::distribution(statistics::sorted(flown_values(table, i)), kMostSteps)) {
      values.push_back(step.value);
      shares.push_back(step.share);
    }
    json.push_back({{"values", base64(values)}, {"shares", base64(shares)}});
  }
  return json;
}

}  // namespace

std::string campaign_page_data(const CampaignReport& report) {
  return inline_json({{"description", report.description},
                      {"drawn_drivers", kDriversDrawn},
                      {"report", campaign_report_value(report)},
                      {"distributions", distributions_json(report.campaign.table)},
                      {"scatter", scatter_json(report)}});
}

}  // namespace twincraft
