// The results of a campaign as netCDF-4, by the CF conventions: a dimension `member`, a variable
// per column of campaign.csv with its unit, its meaning, and the distribution that it was drawn
// from.
#pragma once

#include <string>

#include "runtime/campaign/table.h"
#include "runtime/study/provenance.h"

namespace twincraft {

/// The bytes are a function of the arguments alone. An output without a value is NaN.
/// @param path  of a file that is replaced
/// @throws std::runtime_error  the library fails, or there is none (see has_netcdf); two columns
///         have one name
void write_campaign_netcdf(const std::string& path, const CampaignTable& table,
                           const Provenance& provenance);

}  // namespace twincraft
