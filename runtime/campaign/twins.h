// Members that both engines flew: how often the engines disagree, and whether that follows what was
// drawn.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "runtime/campaign/summary.h"
#include "runtime/campaign/table.h"

namespace twincraft {

/// A drawn number and how its ranks differ between members that disagree and members that agree.
struct TwinDriver {
  std::size_t drawn = 0;  // column
  // That it is larger in a member that disagrees than in one that agrees, both taken at random.
  double larger = 0.5;
  // That chance alone lets any of the drawn numbers differ as much (Mann and Whitney, times how
  // many numbers were looked at).
  double p_value = 1.0;
};

struct TwinFindings {
  TwinCount count;
  // Of the share that disagrees among those that were judged, agree + disagree: Clopper-Pearson,
  // 95 %.
  statistics::Interval interval;
  std::vector<std::size_t> disagreeing;  // members
  std::optional<TwinDriver> driver;      // nothing: only one kind exists, or nothing was drawn
};
TwinFindings find_twins(const CampaignTable& table);

}  // namespace twincraft
