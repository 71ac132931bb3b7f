// The table of a campaign: one row per member in their order, from any number of shards.
#include "runtime/campaign/table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "runtime/campaign/merge.h"
#include "tests/campaign/handmade.h"

namespace twincraft {
namespace {

using test::campaign_header;
using test::failed_member;
using test::member_record;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string words(const std::vector<MemberRange>& ranges) { return range_words(ranges); }

TEST(CampaignTable, HasItsRowsInTheOrderOfMembers) {
  CampaignTable table(campaign_header());
  MemberRecord last = member_record(7);
  last.twin = Verdict::kAgree;
  last.verdict = Verdict::kAgree;
  table.add(last);
  table.add(member_record(2));
  table.add(failed_member(4, "it broke"));
  ASSERT_EQ(table.settle(10), "");
  EXPECT_THAT(table.members(), ElementsAre(2, 4, 7));
  EXPECT_THAT(table.drawn(0), ElementsAre(600.0 + 2.0 / 3.0, 600.0 + 4.0 / 3.0, 600.0 + 7.0 / 3.0));
  EXPECT_THAT(table.output(0), ElementsAre(2e-3, testing::IsNan(), 7e-3));
  EXPECT_EQ(table.reason(0), "");
  EXPECT_EQ(table.reason(1), "it broke");
  EXPECT_EQ(table.verdict(2), Verdict::kAgree);
  EXPECT_EQ(table.twin(2), Verdict::kAgree);
  EXPECT_EQ(table.twin(1), std::nullopt);
  EXPECT_TRUE(table.is_flown(0));
  EXPECT_FALSE(table.is_flown(1));
}

TEST(CampaignTable, GivesBackWhatWasAdded) {
  MemberRecord twin = member_record(7);
  twin.twin = twin.verdict = Verdict::kAgree;
  twin.outputs = {0.2, 0.0};
  CampaignTable table(campaign_header());
  for (const MemberRecord& record : {member_record(2), failed_member(4, "it broke"), twin})
    table.add(record);
  ASSERT_EQ(table.settle(10), "");
  EXPECT_EQ(table.record(0), member_record(2));
  EXPECT_EQ(table.record(1), failed_member(4, "it broke"));
  EXPECT_EQ(table.record(2), twin);
}

TEST(CampaignTable, SaysWhichMembersAreMissing) {
  CampaignTable table(campaign_header());
  EXPECT_EQ(words(table.missing(3)), "0-2");
  for (const std::size_t member : {1, 2, 5}) table.add(member_record(member));
  ASSERT_EQ(table.settle(9), "");
  EXPECT_EQ(words(table.missing(9)), "0, 3-4, 6-8");
  EXPECT_EQ(words(table.missing(6)), "0, 3-4");
  EXPECT_EQ(words(table.missing(0)), "");
}

TEST(CampaignTable, NamesTheFirstRangesOfMany) {
  std::vector<MemberRange> ranges;
  for (std::size_t i = 0; i < 13; ++i) ranges.push_back({10 * i, 10 * i + 1});
  EXPECT_THAT(words(ranges), testing::EndsWith("80-81, 90-91 and 6 more"));
}

TEST(CampaignTable, TakesAMemberTwiceWhenItIsTheSame) {
  CampaignTable table(campaign_header());
  MemberRecord again = member_record(3);
  again.seconds = 9.0;
  table.add(member_record(3));
  table.add(again);
  ASSERT_EQ(table.settle(10), "");
  EXPECT_THAT(table.members(), ElementsAre(3));
  EXPECT_EQ(table.seconds()[0], 0.25);
}

TEST(CampaignTable, RefusesAMemberWithTwoResults) {
  const auto with = [](auto change) {
    CampaignTable table(campaign_header());
    MemberRecord other = member_record(3);
    change(other);
    table.add(member_record(3));
    table.add(other);
    return table.settle(10);
  };
  const std::string refusal = "member 3 was flown twice, with different results";
  EXPECT_EQ(with([](MemberRecord& r) { r.drawn[1] = std::nextafter(-0.1, 0.0); }), refusal);
  EXPECT_EQ(with([](MemberRecord& r) { r.outputs[0].reset(); }), refusal);
  EXPECT_EQ(with([](MemberRecord& r) { r.verdict = Verdict::kAgree; }), refusal);
  EXPECT_EQ(with([](MemberRecord& r) { r.twin = Verdict::kAgree; }), refusal);
  EXPECT_EQ(with([](MemberRecord& r) { r.reason = "x"; }), refusal);
}

TEST(CampaignTable, LeavesOutMembersThatTheCampaignNoLongerHas) {
  CampaignTable table(campaign_header());
  for (const std::size_t member : {8, 1, 12}) table.add(member_record(member));
  ASSERT_EQ(table.settle(8), "");
  EXPECT_THAT(table.members(), ElementsAre(1));
}

std::string shard(const std::vector<std::size_t>& members, std::size_t of,
                  const RecordsHeader& header = campaign_header()) {
  std::string text = header_line(header) + members_line(of);
  for (const std::size_t member : members) text += record_line(member_record(member));
  return text;
}

struct Merged {
  std::vector<std::string> refusals;
  std::string error;
  std::optional<MergedCampaign> campaign;

  explicit Merged(const std::vector<std::string>& shards) {
    CampaignMerge merge;
    for (const std::string& text : shards) {
      std::istringstream in(text);
      if (const std::string why = merge.add("shard", in); !why.empty()) refusals.push_back(why);
    }
    campaign = std::move(merge).finish(error);
  }
};

TEST(CampaignMerge, MakesOneTableOfShards) {
  const Merged merged({shard({0, 3}, 6), shard({1, 4}, 6), shard({2, 5}, 6)});
  ASSERT_TRUE(merged.campaign.has_value());
  EXPECT_THAT(merged.campaign->table.members(), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(merged.campaign->missing, IsEmpty());
  EXPECT_THAT(merged.campaign->remarks, IsEmpty());
  EXPECT_EQ(merged.campaign->members, 6u);
}

TEST(CampaignMerge, SaysWhatIsMissing) {
  const std::string torn = shard({1, 4}, 9);
  const Merged merged({shard({0, 3}, 6), torn.substr(0, torn.size() - 3), ""});
  ASSERT_TRUE(merged.campaign.has_value());
  EXPECT_EQ(merged.campaign->members, 9u);  // a shard knows of more
  EXPECT_EQ(words(merged.campaign->missing), "2, 4-8");
  EXPECT_THAT(merged.campaign->remarks,
              ElementsAre("`shard`: record 2 is cut off", "`shard` is empty"));
}

TEST(CampaignMerge, RefusesShardsOfOtherCampaigns) {
  RecordsHeader other = campaign_header();
  other.spec_sha256 = "def";
  const Merged merged({shard({0}, 2), shard({1}, 2, other), "hello"});
  EXPECT_THAT(merged.refusals, ElementsAre("`shard`: they are results of another spec",
                                           "`shard`: it holds no results of a campaign"));
  EXPECT_THAT(merged.campaign->table.members(), ElementsAre(0));
}

TEST(CampaignMerge, RemarksOnDifferentInstructions) {
  RecordsHeader other = campaign_header();
  other.instructions = "AVX-512";
  const Merged merged({shard({0}, 2), shard({1}, 2, other)});
  EXPECT_THAT(merged.campaign->remarks,
              ElementsAre("shards flew with AVX-512 and AVX2: last digits may differ"));
}

TEST(CampaignMerge, RefusesAMemberWithTwoResults) {
  MemberRecord other = member_record(0);
  other.outputs[0] = 5.0;
  const Merged merged({shard({0}, 2), shard({}, 2) + record_line(other)});
  EXPECT_FALSE(merged.campaign.has_value());
  EXPECT_THAT(merged.error, HasSubstr("member 0 was flown twice"));
}

TEST(CampaignMerge, OfNothingIsNothing) {
  const Merged merged({"", ""});
  EXPECT_FALSE(merged.campaign.has_value());
  EXPECT_EQ(merged.error, "");
}

}  // namespace
}  // namespace twincraft
