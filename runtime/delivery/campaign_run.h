// A campaign flown, in process: all that `scsim SPEC -o DIR [--shard I/N] [--resume]` does of a
// spec with a `campaign`, and `scsim merge DIR`, but read flags and print.
// Tested by tests/runtime/campaign_delivery_test.cpp.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/delivery/campaign_shards.h"
#include "runtime/delivery/compiled_spec.h"
#include "runtime/delivery/exit_code.h"
#include "runtime/report/campaign_report.h"
#include "runtime/study/member.h"

namespace twincraft {

struct CampaignRequest {
  RunOptions options;  // but for its engines: see Twins
  int jobs = 1;
  std::string folder;          // empty: nothing is written
  std::optional<Shard> shard;  // nothing: all members, and the merge
  bool resume = false;         // keep what the folder has of this campaign
  /// The bytes of shards' files that were flown elsewhere: their members are taken from there, the
  /// others are flown. @pre there is a folder
  std::vector<std::string_view> records = {};
  bool stops_on_failure = false;
  bool netcdf = false;       // trajectories of members that are kept as netCDF, too
  std::string program = {};  // that the report names; empty: `scsim VERSION`
  /// Which members both engines fly: as the campaign says, all, or none.
  enum class Twins { kPlanned, kAll, kNone } twins = Twins::kPlanned;
};

/// A campaign, or a shard of one, that has ended, whatever came of it.
struct CampaignResult {
  // Of all members there are records of; nothing of a shard, or where there are none.
  std::optional<CampaignReport> report = {};
  std::size_t flown = 0, resumed = 0;     // members, by this run and before it
  Verdict verdict = Verdict::kAgree;      // of both
  bool breaks_requirements = false;       // one of them does
  bool is_interrupted = false;            // by a signal
  std::string error = {};                 // of files, or of what they hold: exit 3
  std::vector<std::string> remarks = {};  // on what was read

  int exit_code() const;  // kExitInterrupted for any signal
};

/// @param compiled  of a spec with a campaign
CampaignResult fly_campaign(const CompiledSpec& compiled, const CampaignRequest& request);

/// The spec that the shards in a folder are of, with as many members as they say.
Compilation compile_shards(const std::string& folder, const Wanted& wanted,
                           Diagnostics& diagnostics);

/// The records of all shards in request.folder made campaign.csv, campaign.nc, report.json and
/// report.html, and the members flown whose trajectories are kept.
/// @param compiled  of compile_shards()
CampaignResult merge_campaign(const CompiledSpec& compiled, const CampaignRequest& request);

}  // namespace twincraft
