// In place of netcdf.cpp and campaign_netcdf.cpp where a build was configured with
// TWINCRAFT_NETCDF=OFF.
#include <stdexcept>

#include "runtime/report/campaign_netcdf.h"
#include "runtime/report/netcdf.h"

namespace twincraft {

bool has_netcdf() { return false; }

class NetcdfFile::Contents {};

NetcdfFile::NetcdfFile(const std::string& /*path*/, const Bundle& /*bundle*/,
                       std::string_view /*engine*/, const Provenance& /*provenance*/) {
  throw std::runtime_error("this build has no netCDF");
}

void write_campaign_netcdf(const std::string& /*path*/, const CampaignTable& /*table*/,
                           const Provenance& /*provenance*/) {
  throw std::runtime_error("this build has no netCDF");
}

NetcdfFile::~NetcdfFile() = default;
void NetcdfFile::take(const Observation& /*sample*/) {}
void NetcdfFile::close() {}

}  // namespace twincraft
