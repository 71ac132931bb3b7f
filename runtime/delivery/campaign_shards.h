// The parts of a campaign in its folder: DIR/shards/2-of-8.records, a file per shard, each of which
// one program at a time appends to. Tested by tests/runtime/campaign_delivery_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/files/output.h"
#include "runtime/campaign/merge.h"
#include "runtime/campaign/records.h"

namespace twincraft {

/// One of `count` parts of equal size: member m is of shard m modulo `count`, plus 1.
struct Shard {
  std::size_t index = 1, count = 1;

  bool takes(std::size_t member) const { return member % count == index - 1; }
  std::string file_name() const;  // `2-of-8.records`
};
inline constexpr std::size_t kMostShards = 100'000;
/// Of `2/8`. @param why  set when there is no such shard
std::optional<Shard> parse_shard(std::string_view text, std::string& why);

class CampaignShards {
 public:
  /// @param folder  DIR
  explicit CampaignShards(const std::filesystem::path& folder) : folder_(folder / "shards") {}

  /// What of a campaign has been flown.
  struct Found {
    std::string error = {};  // results of another spec, or of no campaign: exit 3
    std::vector<bool> done;  // by member
    // Of the shard's own file.
    std::uintmax_t whole_bytes = 0;
    bool has_header = false;
    std::optional<std::size_t> members = {};
  };
  /// @param take  is given every record of a member of `own`, each member once
  Found find(const RecordsHeader& header, const Shard& own, std::size_t members,
             const std::function<void(const MemberRecord&)>& take = {}) const;

  /// How many members the campaign has, by the largest number that a part says; 0: there is none.
  std::size_t members() const;

  /// The spec, every default filled in: what the parts are merged by.
  std::filesystem::path spec() const { return folder_ / "spec.yaml"; }

  /// All parts as one table. @return nothing where there is none; `error` says why, if anything
  /// is wrong
  std::optional<MergedCampaign> merge(std::string& error) const;

  std::filesystem::path path_of(const Shard& shard) const { return folder_ / shard.file_name(); }
  /// Those that are not `own`, of an earlier campaign.
  void remove_others(const Shard& own) const;
  /// All parts, and the spec; parts that lie there already go. @return as write_files
  std::string copy_to(const CampaignShards& other) const;

 private:
  std::vector<std::filesystem::path> files() const;  // sorted

  std::filesystem::path folder_;
};

/// Shards' files that were flown elsewhere, as one table. @param files  their bytes
/// @return nothing where `error` says why they are not of the campaign that `header` is of
std::optional<MergedCampaign> merge_records(const RecordsHeader& header,
                                            std::span<const std::string_view> files,
                                            std::string& error);

/// A shard's file, as members are flown.
class ShardFile {
 public:
  /// Goes on behind what was found, or starts afresh.
  ShardFile(const std::filesystem::path& path, const CampaignShards::Found& found,
            const RecordsHeader& header, std::size_t members);

  void append(const MemberRecord& record) { file_.append(record_line(record)); }
  const std::string& error() const { return file_.error(); }  // empty, or what went wrong first

 private:
  GrowingFile file_;
};

}  // namespace twincraft
