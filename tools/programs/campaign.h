// scsim of a spec with a `campaign`, and `scsim merge`.
// Tested by tests/agreement/campaign_test.cpp.
#pragma once

#include <string>

#include "runtime/delivery/campaign_run.h"
#include "tools/programs/command.h"

namespace twincraft {

/// What a campaign is asked for beside a run.
struct CampaignOptions {
  std::string shard;
  bool resume = false;
  bool stop_on_failure = false;

  /// The first flag of a campaign that was given; empty: none.
  std::string given() const;
};
void describe_campaign(CommandLine& line, CampaignOptions& options);

/// @param request  without its shard @return the exit code
int fly_campaign_command(const CompiledSpec& compiled, const CommonOptions& common,
                         const CampaignOptions& options, CampaignRequest request);

int merge_command(int argc, char** argv);

}  // namespace twincraft
