// See output_folder.h. Tested by tests/agreement/study_test.cpp.
#include "runtime/delivery/output_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "compiler/ir/engine_kind.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;

/// A member's number of a name such as `0001`; nothing of any other name.
std::optional<std::size_t> member_of(const std::string& name) {
  std::size_t member = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), member);
  if (error != std::errc() || end != name.data() + name.size()) return std::nullopt;
  return name == fmt::format("{:04}", member) ? std::optional(member) : std::nullopt;
}

/// A link is the user's, wherever it leads.
bool is_plain_folder(const fs::path& path) {
  std::error_code error;
  return fs::symlink_status(path, error).type() == fs::file_type::directory;
}

bool is_plain_file(const fs::path& path) {
  std::error_code error;
  return fs::symlink_status(path, error).type() == fs::file_type::regular;
}

void remove_plain(const fs::path& path) {
  std::error_code ignored;
  if (is_plain_file(path)) fs::remove(path, ignored);
}

constexpr std::size_t kNoMember = std::numeric_limits<std::size_t>::max();

std::vector<fs::path> members_in(const fs::path& folder) {
  std::vector<fs::path> members;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (member_of(entry->path().filename().string()) && is_plain_folder(entry->path()))
      members.push_back(entry->path());
  return members;
}

}  // namespace

/// In the order of the bits of written_.
const std::vector<std::string>& OutputFolder::trajectory_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const char* suffix : {".csv", ".nc"})
      for (const EngineName& engine : kEngines)
        all.push_back(fmt::format("{}{}", engine.key, suffix));
    return all;
  }();
  return names;
}

fs::path OutputFolder::of_member(std::size_t index) const {
  const bool is_beside = index == 0 && first_ == First::kBeside;
  return is_beside ? folder_ : folder_ / fmt::format("{:04}", index);
}

void OutputFolder::wrote(std::size_t member, std::string_view name) {
  const auto file = std::ranges::find(trajectory_names(), name) - trajectory_names().begin();
  if (written_.size() <= member) written_.resize(member + 1, 0);
  written_[member] = static_cast<std::uint8_t>(written_[member] | 1U << file);
}

bool OutputFolder::has_written(std::size_t member, std::size_t file) const {
  return member < written_.size() && (written_[member] >> file & 1U) != 0;
}

void OutputFolder::for_each_written(
    const std::function<void(std::size_t member, const std::string& name)>& visit) const {
  for (std::size_t member = 0; member < written_.size(); ++member)
    for (std::size_t file = 0; file < trajectory_names().size(); ++file)
      if (has_written(member, file)) visit(member, trajectory_names().at(file));
}

void OutputFolder::clean(const fs::path& folder, std::size_t member) const {
  for (std::size_t file = 0; file < trajectory_names().size(); ++file) {
    if (!has_written(member, file)) remove_plain(folder / trajectory_names().at(file));
  }
}

void OutputFolder::remove_leftovers() const {
  const bool is_campaign = first_ == First::kApart;
  clean(folder_, is_campaign ? kNoMember : 0);
  if (!is_campaign)
    for (const char* table : {"campaign.csv", "campaign.nc"}) remove_plain(folder_ / table);
  for (const fs::path& folder : members_in(folder_)) {
    std::error_code ignored;
    if (fs::exists(folder / "report.json", ignored) || fs::exists(folder / "report.html", ignored))
      continue;
    const std::size_t member = *member_of(folder.filename().string());
    clean(folder, of_member(member) == folder ? member : kNoMember);
    if (fs::is_empty(folder, ignored)) fs::remove(folder, ignored);
  }
}

}  // namespace twincraft
