// A campaign for people: the spread of its outputs, how often requirements hold, and what went
// wrong.
#pragma once

#include <string>

#include "runtime/campaign/merge.h"

namespace twincraft {

/// Ends with a line end.
std::string campaign_table(const MergedCampaign& campaign);

}  // namespace twincraft
