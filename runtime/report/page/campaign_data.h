// Everything the page of a campaign shows, as one JSON document: its report.json as it is, and what
// only pictures need, thinned to what a picture shows.
#pragma once

#include <string>

#include "runtime/report/campaign_report.h"

namespace twincraft {

/// Text that may stand inside a script element: no `<` in it.
std::string campaign_page_data(const CampaignReport& report);

}  // namespace twincraft
