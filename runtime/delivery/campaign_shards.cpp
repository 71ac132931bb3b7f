// See campaign_shards.h.
#include "runtime/delivery/campaign_shards.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>
#include <system_error>

#include "compiler/diag/diagnostics.h"
#include "runtime/delivery/file_parts.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kOf = "-of-", kSuffix = ".records";

std::optional<std::size_t> number_of(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  return is_number ? std::optional(number) : std::nullopt;
}

/// Whether it is a name as Shard::file_name() gives. Whatever else lies there is the user's.
bool is_of_a_shard(std::string_view name) {
  const std::size_t of = name.find(kOf);
  if (of == std::string_view::npos || !name.ends_with(kSuffix)) return false;
  name.remove_suffix(kSuffix.size());
  return number_of(name.substr(0, of)) && number_of(name.substr(of + kOf.size()));
}

/// Marks the members of one file. @param take  is given those that were not marked
void mark(RecordReader& reader, CampaignShards::Found& found,
          const std::function<void(const MemberRecord&)>& take) {
  for (MemberRecord record; reader.next(record);) {
    if (record.member >= found.done.size() || found.done[record.member]) continue;
    found.done[record.member] = true;
    take(record);
  }
}

}  // namespace

std::string Shard::file_name() const { return fmt::format("{}{}{}{}", index, kOf, count, kSuffix); }

std::optional<Shard> parse_shard(std::string_view text, std::string& why) {
  const std::size_t slash = text.find('/');
  std::optional<std::size_t> index, count;
  if (slash != std::string_view::npos) {
    index = number_of(text.substr(0, slash));
    count = number_of(text.substr(slash + 1));
  }
  if (!index || !count)
    why = fmt::format("{} is no I/N, such as 2/8", in_backticks(text));
  else if (*count < 1 || *count > kMostShards)
    why = fmt::format("there are 1 to {} shards, not {}", kMostShards, *count);
  else if (*index < 1 || *index > *count)
    why = fmt::format("of {} shards there is none with the number {}: they count from 1", *count,
                      *index);
  if (!why.empty()) return std::nullopt;
  return Shard{*index, *count};
}

std::vector<fs::path> CampaignShards::files() const {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end;
       entry.increment(error))
    if (is_of_a_shard(entry->path().filename().string()) && entry->is_regular_file(error))
      files.push_back(entry->path());
  std::ranges::sort(files);
  return files;
}

CampaignShards::Found CampaignShards::find(
    const RecordsHeader& header, const Shard& own, std::size_t members,
    const std::function<void(const MemberRecord&)>& take) const {
  Found found{.done = std::vector<bool>(members)};
  const auto take_own = [&](const MemberRecord& record) {
    if (take && own.takes(record.member)) take(record);
  };
  for (const fs::path& path : files()) {
    std::ifstream in(path, std::ios::binary);
    RecordReader reader(in);
    const std::string why = !reader.error().empty() ? reader.error()
                            : reader.header()       ? difference(header, *reader.header())
                                                    : "";
    if (!why.empty()) {
      found.error = fmt::format("{}: {}", in_backticks(path.string()), why);
      return found;
    }
    mark(reader, found, take_own);
    if (path != path_of(own)) continue;
    found.whole_bytes = reader.whole_bytes();
    found.has_header = reader.header().has_value();
    found.members = reader.members();
  }
  return found;
}

std::size_t CampaignShards::members() const {
  std::size_t members = 0;
  for (const fs::path& path : files()) {
    std::ifstream in(path, std::ios::binary);
    RecordReader reader(in);
    for (MemberRecord record; reader.error().empty() && reader.next(record);) continue;
    members = std::max(members, reader.members().value_or(0));
  }
  return members;
}

std::optional<MergedCampaign> CampaignShards::merge(std::string& error) const {
  CampaignMerge merge;
  for (const fs::path& path : files()) {
    std::ifstream in(path, std::ios::binary);
    error = merge.add(path.filename().string(), in);
    if (!error.empty()) return std::nullopt;
  }
  return std::move(merge).finish(error);
}

void CampaignShards::remove_others(const Shard& own) const {
  for (const fs::path& path : files()) {
    std::error_code ignored;
    if (path != path_of(own)) fs::remove(path, ignored);
  }
}

std::string CampaignShards::copy_to(const CampaignShards& other) const {
  const std::vector<fs::path> parts = files();
  std::vector<PendingFile> copies;
  std::string error = copy_in_parts(spec(), copies.emplace_back(other.spec()));
  for (const fs::path& part : parts)
    if (error.empty())
      error = copy_in_parts(part, copies.emplace_back(other.folder_ / part.filename()));
  if (error.empty()) error = publish(copies);
  if (!error.empty()) return error;
  for (const fs::path& there : other.files()) {
    std::error_code ignored;
    if (!std::ranges::binary_search(parts, folder_ / there.filename())) fs::remove(there, ignored);
  }
  return {};
}

std::optional<MergedCampaign> merge_records(const RecordsHeader& header,
                                            std::span<const std::string_view> files,
                                            std::string& error) {
  CampaignMerge merge;
  std::istringstream own(header_line(header));  // the others must be of the same campaign
  error = merge.add("own", own);
  for (std::size_t i = 0; i < files.size() && error.empty(); ++i) {
    std::istringstream in{std::string(files[i])};
    error = merge.add(fmt::format("records {}", i + 1), in);
  }
  if (!error.empty()) return std::nullopt;
  return std::move(merge).finish(error);
}

ShardFile::ShardFile(const fs::path& path, const CampaignShards::Found& found,
                     const RecordsHeader& header, std::size_t members)
    : file_(path, found.has_header ? found.whole_bytes : 0) {
  if (!found.has_header) file_.append(header_line(header));
  if (!found.has_header || found.members != members) file_.append(members_line(members));
}

}  // namespace twincraft
