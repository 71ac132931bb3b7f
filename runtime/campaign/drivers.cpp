#include "runtime/campaign/drivers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace twincraft {
namespace {

using Column = std::span<const double>;

constexpr std::size_t kFewestMembers = 16;  // of statistics::sobol_given_data

/// Members times resamplings: more of the former need less of the latter.
constexpr std::size_t kMostResampled = 5'000'000;
constexpr std::size_t kFewestTimes = 50, kMostTimes = 200;

std::vector<std::size_t> flown_rows(const CampaignTable& table) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (table.is_flown(row)) rows.push_back(row);
  return rows;
}

std::vector<double> taken(Column column, std::span<const std::size_t> rows) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const std::size_t row : rows) values.push_back(column[row]);
  return values;
}

/// Empty: nothing speaks against it. @param output  of the members that were flown
std::string obstacle(std::size_t members, Column output, const std::vector<bool>& independent) {
  if (std::ranges::none_of(independent, [](bool is) { return is; }))
    return "no drawn number is independent of the others";
  const auto holes = std::ranges::count_if(output, [](double value) { return std::isnan(value); }) +
                     static_cast<std::ptrdiff_t>(members - output.size());
  if (holes > 0)
    return fmt::format("{} of {} members {} no value", holes, members, holes == 1 ? "has" : "have");
  if (members < kFewestMembers) return fmt::format("fewer than {} members", kFewestMembers);
  if (std::ranges::adjacent_find(output, std::not_equal_to<>()) == output.end())
    return "it is the same in all members";
  return {};
}

void add_indices(const std::vector<std::vector<double>>& drawn, Column output,
                 std::vector<Driver>& drivers, const std::vector<bool>& independent) {
  std::vector<Column> inputs;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < drawn.size(); ++i)
    if (independent[i]) {
      inputs.emplace_back(drawn[i]);
      places.push_back(i);
    }
  statistics::Resampling resampling;
  resampling.times = std::clamp(kMostResampled / output.size(), kFewestTimes, kMostTimes);
  const auto indices = statistics::sobol_given_data(inputs, output, resampling);
  if (!indices) return;
  for (std::size_t k = 0; k < places.size(); ++k) drivers[places[k]].sobol_first = (*indices)[k];
}

}  // namespace

double Driver::strength() const {
  const double monotonic = rank ? rank->coefficient * rank->coefficient : 0.0;
  return std::max(monotonic, sobol_first ? sobol_first->value : 0.0);
}

OutputDrivers drivers_of(const CampaignTable& table, std::size_t output, Sampling sampling,
                         const std::vector<bool>& independent) {
  const std::vector<std::size_t> rows = flown_rows(table);
  const std::vector<double> values = taken(table.output(output), rows);
  OutputDrivers found;
  std::vector<std::vector<double>> drawn;
  for (std::size_t i = 0; i < table.header().drawn.size(); ++i) {
    drawn.push_back(taken(table.drawn(i), rows));
    found.drivers.push_back({i, statistics::spearman(drawn.back(), values), {}});
  }
  found.no_sobol = sampling == Sampling::kSobol
                       ? "points of a Sobol' sequence have patterns that look like dependence"
                       : obstacle(table.rows(), values, independent);
  if (found.no_sobol.empty()) add_indices(drawn, values, found.drivers, independent);
  std::ranges::stable_sort(found.drivers, std::greater<>(), &Driver::strength);
  return found;
}

}  // namespace twincraft
