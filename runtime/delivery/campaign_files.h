// What a campaign leaves in its folder beside its shards: the table, the report and the page.
// Tested by tests/runtime/campaign_delivery_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "runtime/delivery/output_folder.h"
#include "runtime/report/campaign_report.h"

namespace twincraft {

/// campaign.csv, campaign.nc where there is netCDF, report.json and report.html: all or none. What
/// an earlier run left in the folder goes. @return as write_files
std::string write_campaign(const CampaignReport& report, const OutputFolder& folder);

/// The same into another folder than `from`, where it was flown into, with its shards and the
/// trajectories that were kept. @return as write_files
std::string save_campaign(const CampaignReport& report, const std::string& from,
                          const std::string& folder);

/// What they are called in a folder.
std::vector<std::string> campaign_paths(const std::string& folder);

}  // namespace twincraft
