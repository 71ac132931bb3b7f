// All that a campaign found, made once of its results: page, report.json and terminal print it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "runtime/campaign/drivers.h"
#include "runtime/campaign/merge.h"
#include "runtime/campaign/twins.h"

namespace twincraft {

/// A member at the end of an output's distribution.
struct WorstMember {
  std::size_t member = 0;
  double value = 0.0;  // SI; NaN: never reached
  bool holds = true;   // what is required of the output
};
/// The flown members that come nearest to breaking what is required of an output, or break it by
/// most, worst first. Where nothing is required the largest; one that was never reached counts as
/// infinite.
std::vector<WorstMember> worst_members(const CampaignTable& table, std::size_t output,
                                       std::size_t most);

struct OutputFindings {
  OutputSummary summary;
  OutputDrivers drivers;
  std::vector<WorstMember>
      worst;  // empty: nothing is required of the output, nothing is kept by it
};

/// Members that their step does not resolve: what they show says nothing of the vehicle.
struct UnresolvedMembers {
  std::vector<std::size_t> members;  // rising
  std::string reason;                // of the first
};
UnresolvedMembers find_unresolved(const CampaignTable& table);

struct CampaignFindings {
  std::size_t flown = 0;                // members
  std::vector<OutputFindings> outputs;  // one per column
  std::vector<ReasonCount> failures;    // of the members that were not flown
  UnresolvedMembers unresolved;
  TwinFindings twins;
};
/// Takes about a second for 100,000 members with ten drawn numbers and three outputs.
/// @param independent  see drivers_of()
CampaignFindings find_all(const MergedCampaign& campaign, const CampaignPlan& plan,
                          const std::vector<bool>& independent);

}  // namespace twincraft
