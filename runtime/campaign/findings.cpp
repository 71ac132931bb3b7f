#include "runtime/campaign/findings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace twincraft {
namespace {

constexpr std::size_t kWorstShown = 5;  // of each output

/// How far a value is from what is required, negative beyond it.
double margin(const OutputColumn& output, double value) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (std::isnan(value)) value = kInfinity;
  if (!output.is_required()) return -value;
  return std::min(output.below ? *output.below - value : kInfinity,
                  output.above ? value - *output.above : kInfinity);
}

}  // namespace

std::vector<WorstMember> worst_members(const CampaignTable& table, std::size_t output,
                                       std::size_t most) {
  const OutputColumn& column = table.header().outputs[output];
  const std::span<const double> values = table.output(output);
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (table.is_flown(row)) rows.push_back(row);
  const auto end = rows.begin() + static_cast<std::ptrdiff_t>(std::min(most, rows.size()));
  // Of equal members the first, so that the result does not depend on how they are sorted.
  std::ranges::partial_sort(
      rows, end, {}, [&](std::size_t row) { return std::pair(margin(column, values[row]), row); });
  std::vector<WorstMember> worst;
  for (auto row = rows.begin(); row != end; ++row) {
    const double value = values[*row];
    worst.push_back({table.members()[*row], value,
                     holds(column, std::isnan(value) ? std::nullopt : std::optional(value))});
  }
  return worst;
}

UnresolvedMembers find_unresolved(const CampaignTable& table) {
  UnresolvedMembers found;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.verdict(row) != Verdict::kUnresolved) continue;
    if (found.members.empty()) found.reason = table.reason(row);
    found.members.push_back(table.members()[row]);
  }
  return found;
}

CampaignFindings find_all(const MergedCampaign& campaign, const CampaignPlan& plan,
                          const std::vector<bool>& independent) {
  const CampaignTable& table = campaign.table;
  CampaignFindings found;
  for (std::size_t row = 0; row < table.rows(); ++row) found.flown += table.is_flown(row) ? 1 : 0;
  for (std::size_t i = 0; i < table.header().outputs.size(); ++i) {
    const OutputColumn& output = table.header().outputs[i];
    OutputFindings& one = found.outputs.emplace_back();
    one.summary = summarise_output(table, i, campaign.members);
    one.drivers = drivers_of(table, i, plan.sampling, independent);
    if (output.is_required() || output.name == plan.keep_by)
      one.worst = worst_members(table, i, kWorstShown);
  }
  found.failures = failures(table);
  found.unresolved = find_unresolved(table);
  found.twins = find_twins(table);
  return found;
}

}  // namespace twincraft
