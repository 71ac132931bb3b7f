// Claims about the parts of a campaign in its folder: what a shard is called, what is found in it,
// what is kept, and the number that a program ends with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "runtime/delivery/campaign_files.h"
#include "runtime/delivery/campaign_kept.h"
#include "runtime/delivery/campaign_run.h"
#include "runtime/delivery/campaign_shards.h"
#include "tests/campaign/handmade.h"
#include "tests/support/run_program.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;
using test::campaign_header;
using test::failed_member;
using test::member_record;
using test::TemporaryFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST(Shard, IsReadAsOneOfSeveral) {
  std::string why;
  const std::optional<Shard> shard = parse_shard("2/8", why);
  ASSERT_TRUE(shard);
  EXPECT_THAT(*shard, AllOf(Field(&Shard::index, 2U), Field(&Shard::count, 8U)));
  EXPECT_EQ(shard->file_name(), "2-of-8.records");
  EXPECT_TRUE(parse_shard("100000/100000", why));
  EXPECT_EQ(why, "");
}

TEST(Shard, IsRefusedInWords) {
  const auto refusal = [](std::string_view text) {
    std::string why;
    EXPECT_FALSE(parse_shard(text, why)) << text;
    return why;
  };
  for (const char* text : {"", "x", "/", "1/", "/3", "-1/2", "1/2/3", "1 /2", "+1/2", "0x1/2",
                           "1.0/2", "1/99999999999999999999"})
    EXPECT_THAT(refusal(text), HasSubstr("is no I/N, such as 2/8")) << text;
  EXPECT_EQ(refusal("4/3"), "of 3 shards there is none with the number 4: they count from 1");
  EXPECT_EQ(refusal("0/3"), "of 3 shards there is none with the number 0: they count from 1");
  EXPECT_EQ(refusal("1/0"), "there are 1 to 100000 shards, not 0");
  EXPECT_EQ(refusal("1/100001"), "there are 1 to 100000 shards, not 100001");
}

TEST(Shard, TakesEachMemberOnce) {
  for (std::size_t member = 0; member < 20; ++member) {
    std::size_t takers = 0;
    for (std::size_t index = 1; index <= 3; ++index)
      if (Shard{index, 3}.takes(member)) ++takers;
    EXPECT_EQ(takers, 1U) << member;
  }
  EXPECT_TRUE((Shard{1, 3}.takes(0)));
  EXPECT_TRUE((Shard{2, 3}.takes(4)));
}

/// A shard's file with these members.
std::string records(const std::vector<std::size_t>& members, std::size_t of,
                    const RecordsHeader& header = campaign_header()) {
  std::string text = header_line(header) + members_line(of);
  for (const std::size_t member : members) text += record_line(member_record(member));
  return text;
}

class CampaignFolder : public testing::Test {
 protected:
  CampaignFolder() { fs::create_directory(folder.path() + "/shards"); }

  /// A shard's file with these members.
  void write(const Shard& shard, const std::vector<std::size_t>& members, std::size_t of,
             const RecordsHeader& header = campaign_header()) const {
    folder.write("shards/" + shard.file_name(), records(members, of, header));
  }
  std::string read(const Shard& shard) const { return folder.read("shards/" + shard.file_name()); }

  TemporaryFolder folder;
  CampaignShards shards{folder.path()};
};

TEST_F(CampaignFolder, IsEmptyBeforeItsFirstShard) {
  const CampaignShards nowhere(folder.path() + "/nowhere");
  for (const CampaignShards* none : {&std::as_const(shards), &nowhere}) {
    EXPECT_EQ(none->members(), 0U);
    const CampaignShards::Found found = none->find(campaign_header(), {}, 3);
    EXPECT_EQ(found.error, "");
    EXPECT_THAT(found.done, ElementsAre(false, false, false));
    EXPECT_FALSE(found.has_header);
    std::string error;
    EXPECT_FALSE(none->merge(error));
    EXPECT_EQ(error, "");
  }
}

TEST_F(CampaignFolder, FindsTheMembersOfAllShardsAndTheEndOfItsOwn) {
  write({1, 2}, {0, 2}, 5);
  write({2, 2}, {1}, 6);
  folder.write("shards/2-of-2.records", read({2, 2}) + "cut o");
  const CampaignShards::Found found = shards.find(campaign_header(), {2, 2}, 5);
  EXPECT_THAT(found.done, ElementsAre(true, true, true, false, false));
  EXPECT_TRUE(found.has_header);
  EXPECT_EQ(found.members, 6U);
  EXPECT_EQ(found.whole_bytes, read({2, 2}).size() - 5);
  EXPECT_EQ(shards.members(), 6U);
  // Members beyond the campaign are nobody's.
  EXPECT_THAT(shards.find(campaign_header(), {2, 2}, 1).done, ElementsAre(true));
}

TEST_F(CampaignFolder, GivesTheRecordsOfAShardOnce) {
  write({1, 2}, {0, 2, 4, 9}, 6);
  write({2, 2}, {1, 3}, 6);
  write({1, 1}, {0, 1}, 6);  // flown before there were two shards
  const auto taken = [this](const Shard& own) {
    std::vector<std::size_t> members;
    shards.find(campaign_header(), own, 6,
                [&](const MemberRecord& record) { members.push_back(record.member); });
    std::ranges::sort(members);
    return members;
  };
  EXPECT_THAT(taken({1, 2}), ElementsAre(0, 2, 4));
  EXPECT_THAT(taken({2, 2}), ElementsAre(1, 3));
  EXPECT_THAT(taken({2, 3}), ElementsAre(1, 4));
}

TEST_F(CampaignFolder, GoesOnBehindWhatIsWhole) {
  write({}, {0, 1}, 4);
  const std::string whole = read({});
  folder.write("shards/1-of-1.records", whole + record_line(member_record(2)).substr(0, 30));
  {
    const CampaignShards::Found found = shards.find(campaign_header(), {}, 4);
    ShardFile file(shards.path_of({}), found, campaign_header(), 4);
    file.append(member_record(2));
    EXPECT_EQ(file.error(), "");
  }
  EXPECT_EQ(read({}), whole + record_line(member_record(2)));
}

TEST_F(CampaignFolder, SaysHowManyMembersThereAreFromNowOn) {
  write({}, {0}, 1);
  const std::string whole = read({});
  {
    ShardFile file(shards.path_of({}), shards.find(campaign_header(), {}, 3), campaign_header(), 3);
  }
  EXPECT_EQ(read({}), whole + members_line(3));
  EXPECT_EQ(shards.members(), 3U);
}

TEST_F(CampaignFolder, BeginsAfreshWhereTheHeaderIsCutOff) {
  folder.write("shards/1-of-1.records", header_line(campaign_header()).substr(0, 40));
  const CampaignShards::Found found = shards.find(campaign_header(), {}, 2);
  EXPECT_EQ(found.error, "");
  { ShardFile file(shards.path_of({}), found, campaign_header(), 2); }
  EXPECT_EQ(read({}), header_line(campaign_header()) + members_line(2));
}

TEST_F(CampaignFolder, RefusesOtherResults) {
  RecordsHeader other = campaign_header();
  other.spec_sha256 = "def";
  write({1, 2}, {0}, 2);
  write({2, 2}, {1}, 2, other);
  EXPECT_THAT(shards.find(campaign_header(), {1, 2}, 2).error,
              AllOf(HasSubstr("2-of-2.records"), HasSubstr("results of another spec")));
  std::string error;
  EXPECT_FALSE(shards.merge(error));
  EXPECT_THAT(error, HasSubstr("2-of-2.records"));
}

TEST_F(CampaignFolder, TakesFilesOfItsNamesAlone) {
  write({}, {0}, 1);
  for (const char* name : {"x.records", "1-of-x.records", "-of-.records", "1-of-1.records.bak",
                           "1-of-2", ".records", "spec.yaml"})
    folder.write(std::string("shards/") + name, "mine\n");
  fs::create_directory(folder.path() + "/shards/2-of-2.records");
  std::string error;
  const std::optional<MergedCampaign> merged = shards.merge(error);
  ASSERT_TRUE(merged) << error;
  EXPECT_EQ(merged->table.rows(), 1U);
  shards.remove_others({1, 3});
  EXPECT_FALSE(folder.has("shards/1-of-1.records"));
  EXPECT_TRUE(folder.has("shards/x.records"));
  EXPECT_TRUE(folder.has("shards/1-of-1.records.bak"));
}

TEST_F(CampaignFolder, MergesItsShards) {
  write({2, 3}, {1, 4}, 6);
  write({1, 3}, {0}, 6);
  std::string error;
  const std::optional<MergedCampaign> merged = shards.merge(error);
  ASSERT_TRUE(merged) << error;
  EXPECT_THAT(merged->table.members(), ElementsAre(0, 1, 4));
  EXPECT_EQ(merged->members, 6U);
  EXPECT_EQ(range_words(merged->missing), "2-3, 5");
  EXPECT_THAT(merged->remarks, IsEmpty());
}

/// A table of these peaks, member by member; nothing: the member failed.
TEST(Records, OfShardsFlownElsewhereAreJoined) {
  const std::string one = records({0, 3}, 4), other = records({1, 3}, 4);
  const std::vector<std::string_view> files{one, other, one};
  std::string error;
  const std::optional<MergedCampaign> merged = merge_records(campaign_header(), files, error);
  ASSERT_TRUE(merged) << error;
  EXPECT_THAT(merged->table.members(), ElementsAre(0, 1, 3));
  EXPECT_THAT(merged->remarks, IsEmpty());
  const std::optional<MergedCampaign> none = merge_records(campaign_header(), {}, error);
  ASSERT_TRUE(none);
  EXPECT_EQ(none->table.rows(), 0U);
}

TEST(Records, OfAnotherCampaignAreRefused) {
  RecordsHeader header = campaign_header();
  header.spec_sha256 = "another";
  const std::string other = records({0}, 1, header);
  std::string error;
  EXPECT_FALSE(merge_records(campaign_header(), std::vector<std::string_view>{other}, error));
  EXPECT_THAT(error, HasSubstr("`records 1`: they are results of another spec"));
}

TEST(Records, OfOtherInstructionsAreRemarkedOn) {
  RecordsHeader header = campaign_header();
  header.instructions = "AVX-512";
  const std::string other = records({0}, 1, header);
  std::string error;
  const std::optional<MergedCampaign> merged =
      merge_records(campaign_header(), std::vector<std::string_view>{other}, error);
  ASSERT_TRUE(merged);
  EXPECT_THAT(merged->remarks,
              ElementsAre("shards flew with AVX-512 and AVX2: last digits may differ"));
}

TEST_F(CampaignFolder, IsCopiedAndTakesThePlaceOfAnother) {
  write({1, 2}, {0}, 2);
  write({2, 2}, {1}, 2);
  folder.write("shards/spec.yaml", "name: x\n");
  const TemporaryFolder to;
  fs::create_directory(to.path() + "/shards");
  to.write("shards/1-of-1.records", "an earlier one");
  to.write("shards/notes.txt", "the user's");
  EXPECT_EQ(shards.copy_to(CampaignShards(to.path())), "");
  for (const char* name : {"shards/1-of-2.records", "shards/2-of-2.records", "shards/spec.yaml"})
    EXPECT_EQ(to.read(name), folder.read(name));
  EXPECT_FALSE(fs::exists(to.path() + "/shards/1-of-1.records"));
  EXPECT_TRUE(fs::exists(to.path() + "/shards/notes.txt"));
}

CampaignTable table_of(const std::vector<std::optional<double>>& peaks,
                       const std::vector<std::size_t>& absent = {}) {
  CampaignTable table(campaign_header());
  for (std::size_t member = 0; member < peaks.size(); ++member) {
    if (std::ranges::find(absent, member) != absent.end()) continue;
    MemberRecord record = peaks[member] ? member_record(member) : failed_member(member, "too full");
    record.outputs[0] = peaks[member];
    table.add(record);
  }
  table.settle(peaks.size());
  return table;
}

CampaignPlan keeping(std::size_t worst, const std::string& by,
                     std::vector<std::size_t> members = {}) {
  CampaignPlan plan;
  plan.keep_worst = worst;
  plan.keep_by = by;
  plan.keep_members = std::move(members);
  return plan;
}

TEST(MembersToKeep, AreThoseWithTheLargestValues) {
  const CampaignTable table = table_of({0.3, 0.1, 0.4, 0.2});
  EXPECT_THAT(members_to_keep(keeping(2, "peak"), table), ElementsAre(0, 2));
  EXPECT_THAT(members_to_keep(keeping(9, "peak"), table), SizeIs(4));
  EXPECT_THAT(members_to_keep(keeping(0, "peak"), table), IsEmpty());
  EXPECT_THAT(members_to_keep(keeping(2, ""), table), IsEmpty());
  EXPECT_THAT(members_to_keep(keeping(2, "touch"), table), IsEmpty());  // which none has reached
}

TEST(MembersToKeep, AreTheFirstOfEqualOnes) {
  EXPECT_THAT(members_to_keep(keeping(2, "peak"), table_of({0.1, 0.4, 0.4, 0.4})),
              ElementsAre(1, 2));
}

TEST(MembersToKeep, AreFlownAndNamedOnce) {
  const CampaignTable table = table_of({0.1, std::nullopt, 0.4, 0.2, 0.3}, {3});
  EXPECT_THAT(members_to_keep(keeping(1, "peak", {4, 2, 3, 1, 7}), table), ElementsAre(2, 4));
  EXPECT_THAT(members_to_keep(keeping(5, "peak"), table), ElementsAre(0, 2, 4));
  EXPECT_THAT(members_to_keep(keeping(1, "peak", {0}), table_of({})), IsEmpty());
}

TEST(CampaignResult, EndsWithTheWorstThatItHas) {
  const auto code = [](Verdict verdict, bool breaks = false) {
    CampaignResult result;
    result.verdict = verdict;
    result.breaks_requirements = breaks;
    return result.exit_code();
  };
  EXPECT_EQ(code(Verdict::kAgree), kExitDone);
  EXPECT_EQ(code(Verdict::kNotJudged), kExitDone);
  EXPECT_EQ(code(Verdict::kDisagree), kExitFindings);
  EXPECT_EQ(code(Verdict::kUnresolved), kExitFindings);
  EXPECT_EQ(code(Verdict::kNotJudged, true), kExitFindings);
  EXPECT_EQ(code(Verdict::kFailed, true), kExitFailure);
  CampaignResult result;
  result.verdict = Verdict::kFailed;
  result.is_interrupted = true;
  EXPECT_EQ(result.exit_code(), kExitInterrupted);
  result.error = "disk full";
  EXPECT_EQ(result.exit_code(), kExitInputOutput);
}

TEST(CampaignResult, IsNoSuccessWhileMembersAreMissing) {
  CampaignResult result;
  CampaignTable table = table_of({0.01});
  result.report = CampaignReport{{std::move(table), 2, {{1, 1}}, {}}, {}, {}};
  result.report->complete = false;
  EXPECT_EQ(result.exit_code(), kExitFindings);
  result.report->complete = true;
  EXPECT_EQ(result.exit_code(), kExitDone);
}

TEST(CampaignPaths, AreNoneWithoutAFolder) {
  EXPECT_THAT(campaign_paths(""), IsEmpty());
  EXPECT_THAT(campaign_paths("out"), testing::Contains("out/campaign.csv"));
}

}  // namespace
}  // namespace twincraft
