// A campaign for people: the spread of its outputs, how often requirements hold, what drives them,
// and what went wrong.
#pragma once

#include <string>

#include "runtime/report/campaign_report.h"

namespace twincraft {

/// Ends with a line end.
std::string campaign_table(const CampaignReport& report);

}  // namespace twincraft
