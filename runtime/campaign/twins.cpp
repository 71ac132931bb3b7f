#include "runtime/campaign/twins.h"

#include <algorithm>
#include <cmath>

#include "runtime/statistics/correlation.h"

namespace twincraft {
namespace {

/// Rows by what became of the twins.
struct Sides {
  std::vector<std::size_t> disagree, agree;
};

Sides sides_of(const CampaignTable& table) {
  Sides sides;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::optional<Verdict> twin = table.twin(row);
    if (twin == Verdict::kDisagree) sides.disagree.push_back(row);
    if (twin == Verdict::kAgree) sides.agree.push_back(row);
  }
  return sides;
}

std::vector<double> taken(std::span<const double> column, const std::vector<std::size_t>& rows) {
  std::vector<double> values;
  for (const std::size_t row : rows) values.push_back(column[row]);
  return values;
}

std::optional<TwinDriver> driver_of(const CampaignTable& table, const Sides& sides) {
  std::optional<TwinDriver> most;
  const std::size_t looked_at = table.header().drawn.size();
  for (std::size_t i = 0; i < looked_at; ++i) {
    const auto differ = statistics::rank_difference(taken(table.drawn(i), sides.disagree),
                                                    taken(table.drawn(i), sides.agree));
    if (!differ) continue;
    if (!most || std::abs(differ->larger - 0.5) > std::abs(most->larger - 0.5))
      most = TwinDriver{i, differ->larger,
                        std::min(1.0, differ->p_value * static_cast<double>(looked_at))};
  }
  return most;
}

}  // namespace

TwinFindings find_twins(const CampaignTable& table) {
  const Sides sides = sides_of(table);
  TwinFindings found{count_twins(table),
                     statistics::clopper_pearson(sides.disagree.size(),
                                                 sides.disagree.size() + sides.agree.size(), 0.95),
                     {},
                     driver_of(table, sides)};
  for (const std::size_t row : sides.disagree) found.disagreeing.push_back(table.members()[row]);
  return found;
}

}  // namespace twincraft
