// Which drawn numbers an output of a campaign follows.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "runtime/campaign/table.h"
#include "runtime/statistics/correlation.h"
#include "runtime/statistics/sobol.h"

namespace twincraft {

/// What an output has to do with one drawn number.
struct Driver {
  std::size_t drawn = 0;                            // column
  std::optional<statistics::RankCorrelation> rank;  // nothing: see statistics::spearman
  std::optional<statistics::Index> sobol_first;     // nothing: see OutputDrivers::no_sobol

  /// Share of the output's spread that the number explains alone, about: the larger one of its
  /// Sobol' index, which sees every dependence, and the square of its rank correlation, which needs
  /// a monotonic one but little data.
  double strength() const;
};

struct OutputDrivers {
  std::vector<Driver> drivers;  // the strongest first
  std::string no_sobol;         // why no number has an index: `3 of 1024 members have no value`
};

/// Of the members that were flown. Sobol' indices are those of independent numbers alone, and of
/// outputs that every member of the table has: with holes they would be those of another set.
/// Points of a Sobol' sequence are evenly spread but not independent of one another: what one
/// number does can look like the doing of another, so of these there are none either.
/// @param independent  one per drawn number: it moves with no other, as correlated numbers, the
///                     components of a drawn direction and numbers drawn together do
OutputDrivers drivers_of(const CampaignTable& table, std::size_t output, Sampling sampling,
                         const std::vector<bool>& independent);

}  // namespace twincraft
