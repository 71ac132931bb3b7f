// Any bytes are results of a campaign up to some byte, or none. What is whole is written again as
// it was read, and a file that is cut off there and goes on is whole.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "runtime/campaign/merge.h"
#include "runtime/campaign/records.h"
#include "tests/fuzz/claim.h"

using namespace twincraft;

namespace {

/// A line with the checksum that it should have, which no fuzzer finds: `!` in its place asks for
/// it.
std::string with_checksums(const std::string& bytes) {
  std::string text;
  std::istringstream in(bytes);
  for (std::string line; std::getline(in, line);) {
    const std::size_t mark = line.find('!');
    if (mark != std::string::npos)
      text += line.substr(0, mark) + checked_line(line.substr(mark + 1));
    else
      text += line + (in.eof() ? "" : "\n");
  }
  return text;
}

std::vector<MemberRecord> read(RecordReader& reader) {
  std::vector<MemberRecord> records;
  for (MemberRecord record; reader.next(record);) records.push_back(record);
  return records;
}

void check(const std::string& text) {
  std::istringstream in(text);
  RecordReader reader(in);
  fuzz::claim(reader.error().empty() || !reader.header());
  const std::vector<MemberRecord> records = read(reader);
  fuzz::claim(reader.whole_bytes() <= text.size());
  fuzz::claim(reader.header() || records.empty());
  if (!reader.header()) return;
  fuzz::claim((reader.whole_bytes() == text.size()) == reader.tail().empty());

  std::string again = header_line(*reader.header());
  for (const MemberRecord& record : records) again += record_line(record);
  std::istringstream second(again);
  RecordReader rewritten(second);
  fuzz::claim(rewritten.header() && difference(*rewritten.header(), *reader.header()).empty());
  fuzz::claim(read(rewritten) == records && rewritten.tail().empty());
}

void check_merge(const std::string& text) {
  CampaignMerge merge;
  for (int shard = 0; shard < 2; ++shard) {
    std::istringstream in(text);
    merge.add("a", in);
  }
  std::string error;
  const std::optional<MergedCampaign> merged = std::move(merge).finish(error);
  fuzz::claim(!merged || error.empty());
  if (merged) fuzz::claim(merged->table.rows() <= merged->members);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = with_checksums({reinterpret_cast<const char*>(data), size});
  check(text);
  check_merge(text);
  return 0;
}
