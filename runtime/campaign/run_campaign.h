// The members of a campaign, flown: compiled, taken through the analytic engine side by side, some
// of them through both engines, and reduced to a record each. The file to read first in this room.
// Tested by tests/campaign/run_campaign_test.cpp.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "compiler/ir/campaign.h"
#include "runtime/campaign/records.h"
#include "runtime/study/run_study.h"

namespace twincraft {

struct CampaignRun {
  CampaignPlan plan;
  std::vector<std::size_t> members;  // to be flown, ascending
  /// What is drawn of a member, and its spec compiled: for the analytic engine, or for both. Called
  /// from several threads at once.
  std::function<std::vector<double>(std::size_t member)> drawn;
  std::function<MemberSpec(std::size_t member, bool both)> compile;
  /// Takes the records in the order of `members`, one call at a time.
  std::function<void(MemberRecord record)> finished;
  /// True: no further member is begun. Asked from several threads at once, as is a stop.
  std::function<bool()> enough = {};
  int jobs = 1;

  /// Both engines fly it.
  bool is_twin(std::size_t member) const {
    return plan.twin_every > 0 && member % plan.twin_every == 0;
  }
};

/// A member that cannot be compiled or flown is a record with its reason. After a stop those that
/// were on their way are dropped. Records do not depend on `jobs`, nor on which members are flown.
void run_campaign(const CampaignRun& run, const RunOptions& options);

/// A member in both engines, as a run of its own: its verdict, and why.
struct TwinFinding {
  Verdict verdict = Verdict::kNotJudged;
  std::string reason;  // empty where nothing is wrong
};
TwinFinding twin_finding(const Member& member);

}  // namespace twincraft
