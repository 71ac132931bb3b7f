// Result files of a campaign's shards, made one table.
#pragma once

#include <cstddef>
#include <istream>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "runtime/campaign/table.h"

namespace twincraft {

struct MergedCampaign {
  CampaignTable table;
  std::size_t members = 0;           // that the campaign has
  std::vector<MemberRange> missing;  // those without a row
  // What people should know: of a shard that is empty, cut off or damaged, and of shards that flew
  // with different instructions.
  std::vector<std::string> remarks;
};

class CampaignMerge {
 public:
  /// Takes all whole records of a shard. @param name  what messages call it
  /// @return empty, or why the shard is not of this campaign: nothing of it was taken
  std::string add(const std::string& name, std::istream& in);

  /// Nothing and no error: no shard had anything. @param error  why there is no table
  std::optional<MergedCampaign> finish(std::string& error) &&;

 private:
  std::optional<CampaignTable> table_;
  std::size_t members_ = 0;
  std::set<std::string> instructions_;
  std::vector<std::string> remarks_;
};

}  // namespace twincraft
