// What a campaign shows as a whole: of each output its spread and how often its requirement holds,
// and why members fell out.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "runtime/campaign/table.h"
#include "runtime/statistics/proportion.h"
#include "runtime/statistics/sample.h"

namespace twincraft {

/// How many of some members hold a requirement, and what that says of all that could be drawn.
struct PassRate {
  std::size_t passed = 0, of = 0;
  statistics::Interval interval;  // Clopper-Pearson, 95 %

  double rate() const { return static_cast<double>(passed) / static_cast<double>(of); }
};

struct OutputSummary {
  std::size_t count = 0;                                 // flown members with a value
  double min = 0.0, median = 0.0, p95 = 0.0, max = 0.0;  // of these, SI; NaN where there are none
  statistics::Bounds p95_bounds;  // of the percentile, by order statistics, 95 %
  // With 95 % confidence, 95 % of all that could be drawn are below the one, and 95 % are above the
  // other (Wilks). Nothing: fewer than 59 values.
  std::optional<double> tolerance_upper, tolerance_lower;
  // Of an output that is required:
  PassRate flown;  // of the members that were flown
  PassRate all;    // of all members: those that were not flown hold nothing
};
OutputSummary summarise_output(const CampaignTable& table, std::size_t column, std::size_t members);

/// Members with one reason in common, whatever the numbers in it.
struct ReasonCount {
  std::string reason;  // numbers left out: `omega_BN_B` is absurd: .. rad/s
  std::size_t count = 0;
  std::size_t first = 0;  // member
};
/// Of the members that were not flown: the most frequent first.
std::vector<ReasonCount> failures(const CampaignTable& table);

/// Of the members that both engines flew.
struct TwinCount {
  std::size_t flown = 0, agree = 0, disagree = 0;
};
TwinCount count_twins(const CampaignTable& table);

}  // namespace twincraft
