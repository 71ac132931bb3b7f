#include "runtime/report/campaign_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

std::string outputs_block(const CampaignReport& report) {
  const std::vector<OutputColumn>& outputs = report.campaign.table.header().outputs;
  std::vector<Row> rows = {{"output", "unit", "min", "median", "p95", "max", "requirement",
                            "held by flown", "held by all"}};
  bool has_requirement = false;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const OutputColumn& output = outputs[i];
    const OutputSummary& found = report.findings.outputs[i].summary;
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

/// `hub.mass (rank 0.85, Sobol' 0.74)`; empty: chance may have brought it.
std::string driver_words(const Driver& driver, const DrawnNumber& drawn) {
  constexpr double kChance = 0.01;
  if (!driver.rank) return {};
  const bool has_index = driver.sobol_first && driver.sobol_first->lower > 0.0;
  if (driver.rank->p_value > kChance && !has_index) return {};
  std::string words = fmt::format("{} (rank {:.2f}", drawn.name, driver.rank->coefficient);
  if (driver.sobol_first) words += fmt::format(", Sobol' {:.2f}", driver.sobol_first->value);
  return words + ')';
}

/// The strongest three of every output.
std::string drivers_block(const CampaignReport& report) {
  constexpr std::size_t kShown = 3;
  const RecordsHeader& header = report.campaign.table.header();
  std::string text;
  for (std::size_t i = 0; i < header.outputs.size(); ++i) {
    const std::vector<Driver>& drivers = report.findings.outputs[i].drivers.drivers;
    std::string words;
    for (std::size_t k = 0; k < std::min(kShown, drivers.size()); ++k) {
      const std::string one = driver_words(drivers[k], header.drawn[drivers[k].drawn]);
      if (!one.empty()) words += (words.empty() ? "" : ", ") + one;
    }
    if (!words.empty()) text += fmt::format("  {} follows {}\n", header.outputs[i].name, words);
  }
  return text;
}

/// The worst member of every required output, and what flies it alone.
std::string worst_block(const CampaignReport& report) {
  std::string text;
  for (std::size_t i = 0; i < report.findings.outputs.size(); ++i) {
    if (report.findings.outputs[i].worst.empty()) continue;
    const OutputColumn& output = report.campaign.table.header().outputs[i];
    const WorstMember& worst = report.findings.outputs[i].worst.front();
    text += std::isnan(worst.value)
                ? fmt::format("  {} was never reached in member {}\n", output.name, worst.member)
                : fmt::format("  worst {}: {} {} in member {}\n", output.name, number(worst.value),
                              output.unit, worst.member);
    const std::string command = reproducing_command(report, worst.member);
    if (!command.empty()) text += fmt::format("    {}\n", command);
  }
  return text;
}

std::string failures_block(const std::vector<ReasonCount>& failures) {
  std::string text;
  for (const ReasonCount& one : failures)
    text +=
        fmt::format("  {} not flown: {} (first: member {})\n", one.count, one.reason, one.first);
  return text;
}

std::string unresolved_line(const UnresolvedMembers& unresolved) {
  if (unresolved.members.empty()) return {};
  return fmt::format("  {} unresolved: {} (first: member {})\n", unresolved.members.size(),
                     unresolved.reason, unresolved.members.front());
}

std::string twins_line(const TwinCount& count) {
  if (count.flown == 0) return {};
  return fmt::format("  flown by both engines: {}; agree: {}; disagree: {}\n", count.flown,
                     count.agree, count.disagree);
}

}  // namespace

std::string campaign_table(const CampaignReport& report) {
  const MergedCampaign& campaign = report.campaign;
  std::string text = fmt::format("{}: {} of {} members flown\n\n", campaign.table.header().name,
                                 report.findings.flown, campaign.members);
  text += outputs_block(report) + drivers_block(report) + worst_block(report) +
          failures_block(report.findings.failures) + unresolved_line(report.findings.unresolved);
  if (!campaign.missing.empty())
    text += fmt::format("  missing: members {}\n", range_words(campaign.missing));
  text += twins_line(report.findings.twins.count);
  for (const std::string& remark : campaign.remarks) text += fmt::format("  {}\n", remark);
  return text;
}

}  // namespace twincraft
