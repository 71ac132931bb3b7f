#include "runtime/report/campaign_table.h"

#include <fmt/format.h>

#include <cmath>

#include "runtime/campaign/summary.h"
#include "runtime/report/columns.h"

namespace twincraft {
namespace {

std::string number(double value) { return std::isnan(value) ? "-" : fmt::format("{:.4g}", value); }

std::string requirement_words(const OutputColumn& output) {
  if (output.below && output.above)
    return fmt::format("above {:.6g}, below {:.6g}", *output.above, *output.below);
  if (output.below) return fmt::format("below {:.6g}", *output.below);
  return output.above ? fmt::format("above {:.6g}", *output.above) : "-";
}

/// `1019 of 1024, 99.5 % (98.9 to 99.8)`
std::string rate_words(const PassRate& pass) {
  if (pass.of == 0) return "-";
  return fmt::format("{} of {}, {:.1f} % ({:.1f} to {:.1f})", pass.passed, pass.of,
                     100.0 * pass.rate(), 100.0 * pass.interval.lower, 100.0 * pass.interval.upper);
}

std::string outputs_block(const MergedCampaign& campaign) {
  const CampaignTable& table = campaign.table;
  std::vector<Row> rows = {{"output", "unit", "min", "median", "p95", "max", "requirement",
                            "held by flown", "held by all"}};
  bool has_requirement = false;
  for (std::size_t i = 0; i < table.header().outputs.size(); ++i) {
    const OutputColumn& output = table.header().outputs[i];
    const OutputSummary found = summarise_output(table, i, campaign.members);
    has_requirement |= output.is_required();
    const auto rate = [&](const PassRate& pass) {
      return output.is_required() ? rate_words(pass) : std::string("-");
    };
    rows.push_back({output.name, output.unit, number(found.min), number(found.median),
                    number(found.p95), number(found.max), requirement_words(output),
                    rate(found.flown), rate(found.all)});
  }
  if (rows.size() == 1) return {};
  if (!has_requirement)
    for (Row& row : rows) row.resize(6);
  std::string text = aligned(rows) + '\n';
  if (has_requirement)
    text +=
        "  Brackets: 95 % confidence (Clopper-Pearson). `all` counts members that were not flown "
        "as broken.\n\n";
  return text;
}

std::string failures_block(const CampaignTable& table) {
  std::string text;
  for (const ReasonCount& one : failures(table))
    text +=
        fmt::format("  {} not flown: {} (first: member {})\n", one.count, one.reason, one.first);
  return text;
}

std::string twins_line(const CampaignTable& table) {
  const TwinCount count = count_twins(table);
  if (count.flown == 0) return {};
  return fmt::format("  flown by both engines: {}; agree: {}; disagree: {}\n", count.flown,
                     count.agree, count.disagree);
}

}  // namespace

std::string campaign_table(const MergedCampaign& campaign) {
  const CampaignTable& table = campaign.table;
  std::size_t flown = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) flown += table.is_flown(row) ? 1 : 0;
  std::string text =
      fmt::format("{}: {} of {} members flown\n\n", table.header().name, flown, campaign.members);
  text += outputs_block(campaign) + failures_block(table);
  if (!campaign.missing.empty())
    text += fmt::format("  missing: members {}\n", range_words(campaign.missing));
  text += twins_line(table);
  for (const std::string& remark : campaign.remarks) text += fmt::format("  {}\n", remark);
  return text;
}

}  // namespace twincraft
