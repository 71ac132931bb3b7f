// What a campaign shows as a whole.
#include "runtime/campaign/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/campaign/handmade.h"

namespace twincraft {
namespace {

using test::campaign_header;
using test::failed_member;
using test::member_record;

/// 201 members of which 200 were flown, with peaks from 0 to 0.199; four are missing.
CampaignTable campaign() {
  CampaignTable table(campaign_header());
  for (std::size_t member = 0; member < 200; ++member) table.add(member_record(member));
  table.add(failed_member(200, "`x` is absurd"));
  EXPECT_EQ(table.settle(205), "");
  return table;
}

TEST(CampaignSummary, IsOfTheMembersThatWereFlown) {
  const OutputSummary found = summarise_output(campaign(), 0, 205);
  EXPECT_EQ(found.count, 200u);
  EXPECT_EQ(found.min, 0.0);
  EXPECT_DOUBLE_EQ(found.median, 0.0995);
  EXPECT_DOUBLE_EQ(found.p95, 0.18905);
  EXPECT_DOUBLE_EQ(found.max, 0.199);
}

TEST(CampaignSummary, CountsRequirementsWithAndWithoutWhatWasNotFlown) {
  const OutputSummary found = summarise_output(campaign(), 0, 205);
  EXPECT_EQ(found.flown.passed, 100u);  // 0.1 itself is not below it
  EXPECT_EQ(found.flown.of, 200u);
  EXPECT_EQ(found.all.passed, 100u);
  EXPECT_EQ(found.all.of, 205u);
  EXPECT_LT(found.flown.interval.lower, 0.5);
  EXPECT_GT(found.flown.interval.upper, 0.5);
}

TEST(CampaignSummary, OfAnOutputThatIsNeverReachedHasNoNumbers) {
  RecordsHeader header = campaign_header();
  header.outputs[1].above = 3.0;  // never before
  CampaignTable table(header);
  table.add(member_record(0));
  table.add(failed_member(1, "x"));
  ASSERT_EQ(table.settle(2), "");
  const OutputSummary found = summarise_output(table, 1, 2);
  EXPECT_EQ(found.count, 0u);
  EXPECT_TRUE(std::isnan(found.max));
  EXPECT_EQ(found.flown.passed, 1u);
  EXPECT_EQ(found.all.of, 2u);
}

TEST(CampaignSummary, CountsFailuresByReasonWhateverTheirNumbers) {
  CampaignTable table(campaign_header());
  table.add(failed_member(7, "at t = 0.5 s `wing_p.1.rate` is absurd: -1.2e+08 rad/s"));
  table.add(failed_member(3, "at t = 12.25 s `wing_p.1.rate` is absurd: 3e+08 rad/s"));
  table.add(failed_member(2, "tank empty, 4, and 3; no"));
  table.add(member_record(1));
  ASSERT_EQ(table.settle(10), "");
  const std::vector<ReasonCount> found = failures(table);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].reason, "at t = .. s `wing_p.1.rate` is absurd: .. rad/s");
  EXPECT_EQ(found[0].count, 2u);
  EXPECT_EQ(found[0].first, 3u);
  EXPECT_EQ(found[1].reason, "tank empty, .., and ..; no");
}

TEST(CampaignSummary, CountsWhatBothEnginesFlew) {
  CampaignTable table(campaign_header());
  for (const auto& [member, twin] : {std::pair{0, Verdict::kAgree},
                                     {1, Verdict::kAgree},
                                     {2, Verdict::kDisagree},
                                     {3, Verdict::kUnresolved}}) {
    MemberRecord record = member_record(static_cast<std::size_t>(member));
    record.twin = twin;
    table.add(record);
  }
  table.add(member_record(4));
  ASSERT_EQ(table.settle(10), "");
  EXPECT_EQ(count_twins(table).flown, 4u);
  EXPECT_EQ(count_twins(table).agree, 2u);
  EXPECT_EQ(count_twins(table).disagree, 1u);
}

}  // namespace
}  // namespace twincraft
