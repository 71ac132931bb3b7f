// report.json of a campaign, format `twincraft-report/1`: what its members show together. Each of
// them is a row of campaign.csv and campaign.nc.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/report/campaign_report.h"

namespace twincraft {

/// What the file holds, for printers that show it otherwise.
nlohmann::ordered_json campaign_report_value(const CampaignReport& report);

/// Numbers that do not exist are null.
std::string campaign_json(const CampaignReport& report);

}  // namespace twincraft
