// The file of a campaign's results: it reads back to the bit, a kill at any byte loses one member
// at most, and no damage is read as a result.
#include "runtime/campaign/records.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "tests/campaign/handmade.h"

namespace twincraft {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

RecordsHeader header() { return test::campaign_header(); }

MemberRecord record(std::size_t member) {
  MemberRecord record = test::member_record(member);
  record.outputs = {5e-324, std::nullopt};
  record.reason = "peak 5.2 rad is not below 5 rad";
  return record;
}

std::string file(std::size_t records) {
  std::string text = header_line(header()) + members_line(10);
  for (std::size_t i = 0; i < records; ++i) text += record_line(record(i));
  return text;
}

struct Read {
  std::vector<MemberRecord> records;
  std::string error, tail;
  std::optional<RecordsHeader> header;
  std::optional<std::size_t> members;
  std::uintmax_t whole_bytes = 0;

  explicit Read(const std::string& text) {
    std::istringstream in(text);
    RecordReader reader(in);
    error = reader.error();
    header = reader.header();
    for (MemberRecord one; reader.next(one);) records.push_back(one);
    MemberRecord none;
    EXPECT_FALSE(reader.next(none));
    tail = reader.tail();
    members = reader.members();
    whole_bytes = reader.whole_bytes();
  }
};

TEST(Records, ReadBackToTheBit) {
  MemberRecord odd = record(3);
  odd.drawn = {std::nextafter(1.0, 2.0), -0.0};
  odd.outputs = {std::numeric_limits<double>::max(), -std::numeric_limits<double>::denorm_min()};
  odd.verdict = Verdict::kAgree;
  odd.twin = Verdict::kDisagree;
  odd.reason = "a\tb\\t\nc\r, \"d\" \xc3\xa4";
  MemberRecord bare = record(std::numeric_limits<std::size_t>::max());
  bare.outputs = {std::nullopt, std::nullopt};
  bare.verdict = Verdict::kFailed;
  bare.reason.clear();
  const Read read(header_line(header()) + record_line(odd) + record_line(bare));
  EXPECT_THAT(read.records, testing::ElementsAre(odd, bare));
  EXPECT_TRUE(std::signbit(read.records[0].drawn[1]));
  EXPECT_EQ(read.error + read.tail, "");
  ASSERT_TRUE(read.header.has_value());
  EXPECT_EQ(read.header->name, "quickstart");
  EXPECT_EQ(read.header->instructions, "AVX2");
  EXPECT_EQ(read.header->drawn[1].nominal, 1.0 / 3.0);
  EXPECT_EQ(read.header->drawn[0].distribution, "normal, sigma 2 %");
  EXPECT_EQ(read.header->outputs, header().outputs);
  EXPECT_EQ(difference(*read.header, header()), "");
}

TEST(Records, SayHowManyMembersThereAreSinceTheLastStart) {
  EXPECT_EQ(Read(file(2)).members, 10u);
  const std::string more = file(2) + members_line(20) + record_line(record(15));
  EXPECT_EQ(Read(more).members, 20u);
  EXPECT_EQ(Read(more).records.size(), 3u);
  EXPECT_EQ(Read(header_line(header())).members, std::nullopt);
}

TEST(Records, CutOffAtAnyByteLoseOneAtMostAndGoOn) {
  constexpr std::size_t kRecords = 3;
  const std::string whole = file(kRecords);
  const std::size_t start = header_line(header()).size();
  for (std::size_t cut = 0; cut < whole.size(); ++cut) {
    const Read read(whole.substr(0, cut));
    ASSERT_EQ(read.error, "") << cut;
    ASSERT_EQ(read.header.has_value(), cut >= start) << cut;
    ASSERT_LE(read.whole_bytes, cut);
    ASSERT_LT(read.records.size(), kRecords) << cut;
    const bool ends_with_a_line = cut == 0 || whole[cut - 1] == '\n';
    if (cut > start) {
      ASSERT_EQ(read.tail.empty(), ends_with_a_line) << cut;
    }
    if (ends_with_a_line) {
      ASSERT_EQ(read.whole_bytes, cut);
    }
    // What a resumed shard writes.
    std::string again = whole.substr(0, read.whole_bytes);
    if (!read.header) again += header_line(header());
    again += members_line(10);
    for (std::size_t i = read.records.size(); i < kRecords; ++i) again += record_line(record(i));
    const Read resumed(again);
    ASSERT_EQ(resumed.error + resumed.tail, "") << cut;
    ASSERT_EQ(resumed.records, Read(whole).records) << cut;
  }
}

TEST(Records, AreNotReadBeyondOneThatIsCutOff) {
  const std::string text = file(2);
  EXPECT_EQ(Read(text.substr(0, text.size() - 1)).tail, "record 2 is cut off");
  EXPECT_EQ(Read(text.substr(0, text.size() - 5) + '\n' + record_line(record(7))).tail,
            "record 2 is damaged");
}

TEST(Records, WithOneBitFlippedAreNeverOthers) {
  const std::string whole = file(3);
  const std::vector<MemberRecord> records = Read(whole).records;
  for (std::size_t byte = 0; byte < whole.size(); ++byte)
    for (int bit = 0; bit < 8; ++bit) {
      std::string flipped = whole;
      flipped[byte] = static_cast<char>(flipped[byte] ^ (1 << bit));
      const Read read(flipped);
      ASSERT_FALSE((read.error + read.tail).empty()) << byte << ' ' << bit;
      ASSERT_LT(read.records.size(), records.size());
      for (std::size_t i = 0; i < read.records.size(); ++i)
        ASSERT_EQ(read.records[i], records[i]) << byte << ' ' << bit;
    }
}

TEST(Records, OfOthersAreRefused) {
  EXPECT_THAT(Read("hello").error, HasSubstr("no results of a campaign"));
  EXPECT_THAT(Read("t [s],x [m]\n0,1\n").error, HasSubstr("no results of a campaign"));
  EXPECT_THAT(Read(std::string(100, '\0')).error, HasSubstr("no results of a campaign"));
  EXPECT_THAT(Read("\n").error, HasSubstr("no results of a campaign"));
  EXPECT_EQ(Read("twincraft-campaign/12 x\n").error,
            "another version wrote it: its format is twincraft-campaign/12, not "
            "twincraft-campaign/1");
  EXPECT_EQ(Read("twincraft-campaign/1\n").error, "its header is damaged");
  EXPECT_EQ(Read("twincraft-campaign/1 00000000 {}\n").error, "its header is damaged");
}

TEST(Records, OfNothingAreNothing) {
  const Read read("");
  EXPECT_EQ(read.error + read.tail, "");
  EXPECT_FALSE(read.header.has_value());
  EXPECT_EQ(read.whole_bytes, 0u);
}

TEST(Records, WithOtherColumnsThanTheHeaderAreDamaged) {
  MemberRecord more = record(0), fewer = record(0);
  more.outputs.emplace_back(1.0);
  fewer.drawn.pop_back();
  for (const MemberRecord& one : {more, fewer}) {
    const Read read(header_line(header()) + record_line(one));
    EXPECT_THAT(read.records, IsEmpty());
    EXPECT_EQ(read.tail, "record 1 is damaged");
  }
}

TEST(Records, AreReadInBoundedMemory) {
  // A line without an end, and one that ends too late.
  const std::string zeros(40U << 20U, '0');
  EXPECT_EQ(Read(file(1) + zeros).tail, "record 2 is cut off");
  EXPECT_EQ(Read(file(1) + zeros + '\n').records.size(), 1u);
}

TEST(Records, AreReadAcrossBlocks) {
  std::string text = file(0);
  for (std::size_t i = 0; i < 5000; ++i) text += record_line(record(i));
  const Read read(text);
  EXPECT_EQ(read.tail, "");
  ASSERT_EQ(read.records.size(), 5000u);
  EXPECT_EQ(read.records.back(), record(4999));
}

TEST(Records, AreTheirHeadersTables) {
  RecordsHeader other = header();
  other.instructions = "AVX-512";
  EXPECT_EQ(difference(header(), other), "");
  other.spec_sha256 = "abd";
  EXPECT_EQ(difference(header(), other), "they are results of another spec");
  other = header();
  other.drawn[0].unit = "g";
  EXPECT_EQ(difference(header(), other), "they have other columns");
  other = header();
  other.outputs[0].below = 0.2;
  EXPECT_EQ(difference(header(), other), "they have other columns");
}

}  // namespace
}  // namespace twincraft
