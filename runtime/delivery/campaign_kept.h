// The members of a campaign that are looked at closely: flown in both engines once more, with their
// trajectories in DIR/0017/. Tested by tests/runtime/campaign_delivery_test.cpp.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "runtime/campaign/merge.h"
#include "runtime/campaign/run_campaign.h"
#include "runtime/delivery/output_folder.h"

namespace twincraft {

/// Members that the campaign names, and those with the largest values of an output that it names.
/// Rising; those without a row or a value are none of them.
std::vector<std::size_t> members_to_keep(const CampaignPlan& plan, const CampaignTable& table);

struct KeepRequest {
  std::function<MemberSpec(std::size_t member)> compile;  // from several threads at once
  RunOptions options;
  int jobs = 1;
  OutputFolder* folder = nullptr;  // null: nothing is written
  bool netcdf = false;
  Provenance provenance;
};

/// Flies them and adds what both engines say to their rows. @return as write_files
std::string keep_members(const std::vector<std::size_t>& members, const KeepRequest& request,
                         CampaignTable& table);

}  // namespace twincraft
