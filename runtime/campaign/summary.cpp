#include "runtime/campaign/summary.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "runtime/statistics/sample.h"

namespace twincraft {
namespace {

constexpr double kConfidence = 0.95;

PassRate pass_rate(std::size_t passed, std::size_t of) {
  return {passed, of, statistics::clopper_pearson(passed, of, kConfidence)};
}

constexpr double kCoverage = 0.95;

std::optional<double> upper_bound(std::span<const double> rising) {
  const auto bound = statistics::tolerance_bound(rising, kCoverage, kConfidence);
  return bound ? std::optional(bound->value) : std::nullopt;
}

/// As far from the least value as the other is from the greatest.
std::optional<double> lower_bound(std::span<const double> rising) {
  const auto bound = statistics::tolerance_bound(rising, kCoverage, kConfidence);
  return bound ? std::optional(rising[bound->rank - 1]) : std::nullopt;
}

/// A word that is a number, as 12.5 and -1e+06, perhaps with a mark behind it.
bool is_number(std::string_view word) {
  const std::size_t sign = word.starts_with('-') || word.starts_with('+') ? 1 : 0;
  return word.size() > sign && word[sign] >= '0' && word[sign] <= '9';
}

std::string without_numbers(std::string_view reason) {
  std::string text;
  while (!reason.empty()) {
    const std::size_t end = std::min(reason.find(' '), reason.size());
    const std::string_view word = reason.substr(0, end);
    if (is_number(word)) {
      text += "..";
      if (const std::size_t mark = word.find_last_not_of(",;:") + 1; mark < word.size())
        text += word.substr(mark);
    } else {
      text += word;
    }
    if (end < reason.size()) text += ' ';
    reason.remove_prefix(std::min(end + 1, reason.size()));
  }
  return text;
}

}  // namespace

OutputSummary summarise_output(const CampaignTable& table, std::size_t column,
                               std::size_t members) {
  const OutputColumn& output = table.header().outputs[column];
  std::vector<double> values;
  std::size_t flown = 0, passed = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!table.is_flown(row)) continue;
    ++flown;
    const double value = table.output(column)[row];
    values.push_back(value);
    if (holds(output, std::isnan(value) ? std::nullopt : std::optional(value))) ++passed;
  }
  const std::vector<double> rising = statistics::sorted(values);
  const auto at = [&rising](double p) { return statistics::quantile(rising, p); };
  return {rising.size(),
          at(0.0),
          at(0.5),
          at(0.95),
          at(1.0),
          statistics::quantile_bounds(rising, 0.95, kConfidence),
          upper_bound(rising),
          lower_bound(rising),
          pass_rate(passed, flown),
          pass_rate(passed, members)};
}

std::vector<ReasonCount> failures(const CampaignTable& table) {
  std::map<std::string, ReasonCount> found;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.is_flown(row)) continue;
    const std::string reason = without_numbers(table.reason(row));
    ++found.try_emplace(reason, ReasonCount{reason, 0, table.members()[row]}).first->second.count;
  }
  std::vector<ReasonCount> counts;
  for (const auto& [reason, count] : found) counts.push_back(count);
  std::ranges::stable_sort(counts, std::greater<>(), &ReasonCount::count);
  return counts;
}

TwinCount count_twins(const CampaignTable& table) {
  TwinCount count;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::optional<Verdict> twin = table.twin(row);
    if (!twin) continue;
    ++count.flown;
    if (*twin == Verdict::kAgree) ++count.agree;
    if (*twin == Verdict::kDisagree) ++count.disagree;
  }
  return count;
}

}  // namespace twincraft
