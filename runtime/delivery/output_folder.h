// One folder, one run: what an earlier run left under our names goes when a later one is done.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace twincraft {

/// Files of a run in its folder, and that folder's members.
class OutputFolder {
 public:
  /// Where the first member's files lie: beside the report, or in a folder as those of the others.
  enum class First { kBeside, kApart };
  explicit OutputFolder(std::filesystem::path folder, First first = First::kBeside)
      : folder_(std::move(folder)), first_(first) {}

  /// What a member's files of ours may be called: `bsm.csv`, `mujoco.csv`, and the same in netCDF.
  static const std::vector<std::string>& trajectory_names();

  const std::filesystem::path& path() const { return folder_; }
  /// DIR/0001 and so on; of the first member DIR or DIR/0000.
  std::filesystem::path of_member(std::size_t index) const;

  /// This run wrote a file of ours for a member.
  void wrote(std::size_t member, std::string_view name);

  /// Every file that was written, member by member.
  void for_each_written(
      const std::function<void(std::size_t member, const std::string& name)>& visit) const;

  /// Removes files of our names that this run did not write: trajectories beside the report and in
  /// folders of members, which go with their last file; and the table of a campaign, where this was
  /// none. Whatever else lies there stays, and so does
  /// a folder with a report of its own. What cannot be removed stays silently: results are written.
  void remove_leftovers() const;

 private:
  bool has_written(std::size_t member, std::size_t file) const;
  void clean(const std::filesystem::path& folder, std::size_t member) const;

  std::filesystem::path folder_;
  First first_;
  std::vector<std::uint8_t> written_;  // a bit per file of a member
};

}  // namespace twincraft
