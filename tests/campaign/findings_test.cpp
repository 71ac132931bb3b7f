// The members of a campaign to look at, and all findings together.
#include "runtime/campaign/findings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/campaign/handmade_campaign.h"

namespace twincraft {
namespace {

using testing::ElementsAre;

CampaignTable table_of(const std::vector<std::optional<double>>& values,
                       std::optional<double> below, std::optional<double> above) {
  RecordsHeader header;
  header.outputs = {{"peak", "rad", "", below, above}};
  CampaignTable table(header);
  for (std::size_t member = 0; member < values.size(); ++member) {
    MemberRecord record;
    record.member = member;
    record.outputs = {values[member]};
    table.add(record);
  }
  MemberRecord failed;
  failed.member = values.size();
  failed.outputs = {1e9};
  failed.verdict = Verdict::kFailed;
  table.add(failed);
  EXPECT_EQ(table.settle(values.size() + 1), "");
  return table;
}

std::vector<std::size_t> members_of(const std::vector<WorstMember>& worst) {
  std::vector<std::size_t> members;
  for (const WorstMember& one : worst) members.push_back(one.member);
  return members;
}

TEST(WorstMembers, AreThoseNearestToTheBoundOrBeyondIt) {
  EXPECT_THAT(members_of(worst_members(table_of({3.0, 5.0, 4.0}, 4.5, {}), 0, 2)),
              ElementsAre(1u, 2u));
  EXPECT_THAT(members_of(worst_members(table_of({3.0, 5.0, 4.0}, {}, 3.5), 0, 2)),
              ElementsAre(0u, 2u));
  EXPECT_THAT(members_of(worst_members(table_of({3.0, 5.0, 4.0}, 5.5, 0.0), 0, 3)),
              ElementsAre(1u, 2u, 0u));
}

TEST(UnresolvedMembers, AreListedWithTheReasonOfTheFirst) {
  RecordsHeader header;
  CampaignTable table(header);
  for (std::size_t member = 0; member < 4; ++member) {
    MemberRecord record;
    record.member = member;
    if (member % 2 == 1) record.verdict = Verdict::kUnresolved;
    record.reason = "reason " + std::to_string(member);
    table.add(record);
  }
  const UnresolvedMembers found = find_unresolved(table);
  EXPECT_THAT(found.members, ElementsAre(1u, 3u));
  EXPECT_EQ(found.reason, "reason 1");
}

TEST(WorstMembers, SayWhetherTheRequirementHolds) {
  const std::vector<WorstMember> worst = worst_members(table_of({3.0, 5.0}, 4.5, {}), 0, 5);
  ASSERT_EQ(worst.size(), 2u);  // the failed member does not count
  EXPECT_FALSE(worst[0].holds);
  EXPECT_EQ(worst[0].value, 5.0);
  EXPECT_TRUE(worst[1].holds);
}

TEST(WorstMembers, ThatNeverReachedItAreInfinitelyLate) {
  const std::vector<WorstMember> late = worst_members(table_of({3.0, {}, 5.0}, 4.5, {}), 0, 1);
  EXPECT_EQ(late[0].member, 1u);
  EXPECT_TRUE(std::isnan(late[0].value));
  EXPECT_FALSE(late[0].holds);
  EXPECT_EQ(members_of(worst_members(table_of({3.0, {}, 5.0}, {}, 4.0), 0, 3)).back(), 1u);
}

TEST(WorstMembers, OfWhatIsNotRequiredAreTheLargestAndOfEqualOnesTheFirst) {
  EXPECT_THAT(members_of(worst_members(table_of({1.0, 7.0, 7.0, 2.0}, {}, {}), 0, 3)),
              ElementsAre(1u, 2u, 3u));
}

TEST(CampaignSummary, BoundsThePercentileAndTheRestOfAllVehicles) {
  std::vector<std::optional<double>> values;
  for (int i = 1; i <= 59; ++i) values.emplace_back(i);
  const OutputSummary of59 = summarise_output(table_of(values, {}, {}), 0, 60);
  EXPECT_EQ(of59.tolerance_upper, 59.0);
  EXPECT_EQ(of59.tolerance_lower, 1.0);
  EXPECT_FALSE(of59.p95_bounds.upper.has_value());
  EXPECT_LT(*of59.p95_bounds.lower, of59.p95);
  values.pop_back();
  const OutputSummary of58 = summarise_output(table_of(values, {}, {}), 0, 59);
  EXPECT_FALSE(of58.tolerance_upper || of58.tolerance_lower);
}

TEST(CampaignFindings, CoverAllOutputs) {
  const MergedCampaign campaign = test::driven_campaign(800, 10);
  const CampaignFindings found =
      find_all(campaign, test::driven_plan(800), std::vector<bool>(3, true));
  EXPECT_EQ(found.flown, 789u);
  ASSERT_EQ(found.outputs.size(), 2u);
  EXPECT_EQ(found.outputs[0].worst.size(), 5u);
  EXPECT_TRUE(found.outputs[1].worst.empty());
  EXPECT_EQ(found.failures.size(), 1u);
  EXPECT_EQ(found.failures[0].first, 399u);
  ASSERT_TRUE(found.twins.driver.has_value());
  EXPECT_EQ(found.twins.driver->drawn, 0u);
  EXPECT_EQ(found.twins.driver->larger, 1.0);
  EXPECT_LT(found.twins.driver->p_value, 1e-5);
}

}  // namespace
}  // namespace twincraft
