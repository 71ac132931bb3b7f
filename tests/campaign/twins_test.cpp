// Members that both engines flew.
#include "runtime/campaign/twins.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/campaign/handmade.h"

namespace twincraft {
namespace {

using Twin = std::optional<Verdict>;

/// `hub.mass` is the number given; `wheels.w.speed` is the same in all.
CampaignTable table_of(const std::vector<std::pair<double, Twin>>& members) {
  CampaignTable table(test::campaign_header());
  for (std::size_t i = 0; i < members.size(); ++i) {
    MemberRecord record = test::member_record(i);
    record.drawn = {members[i].first, -0.1};
    record.twin = members[i].second;
    table.add(record);
  }
  EXPECT_EQ(table.settle(members.size()), "");
  return table;
}

TEST(Twins, AreCountedWithTheirInterval) {
  const TwinFindings found = find_twins(table_of(
      {{1.0, Verdict::kAgree}, {2.0, {}}, {3.0, Verdict::kDisagree}, {4.0, Verdict::kUnresolved}}));
  EXPECT_EQ(found.count.flown, 3u);
  EXPECT_EQ(found.count.agree, 1u);
  EXPECT_EQ(found.count.disagree, 1u);
  EXPECT_THAT(found.disagreeing, testing::ElementsAre(2u));
  // Of one in two: 1 - sqrt(0.975) and its mirror image.
  EXPECT_NEAR(found.interval.lower, 1.0 - std::sqrt(0.975), 1e-12);
  EXPECT_NEAR(found.interval.upper, std::sqrt(0.975), 1e-12);
}

/// 9 of 12 pairs: the interval's correction makes z = 2.5 / sqrt(12 * 8 / 12).
TEST(Twins, NameTheNumberThatTellsThemApart) {
  const TwinFindings found = find_twins(table_of({{5.0, Verdict::kDisagree},
                                                  {3.5, Verdict::kDisagree},
                                                  {2.5, Verdict::kDisagree},
                                                  {1.0, Verdict::kAgree},
                                                  {2.0, Verdict::kAgree},
                                                  {3.0, Verdict::kAgree},
                                                  {4.0, Verdict::kAgree}}));
  ASSERT_TRUE(found.driver.has_value());
  EXPECT_EQ(found.driver->drawn, 0u);
  EXPECT_DOUBLE_EQ(found.driver->larger, 0.75);
  EXPECT_NEAR(found.driver->p_value, 2.0 * std::erfc(2.5 / std::sqrt(8.0) / std::sqrt(2.0)), 1e-12);
}

TEST(Twins, OfOneKindHaveNoDriver) {
  EXPECT_FALSE(find_twins(table_of({{1.0, Verdict::kAgree}, {2.0, Verdict::kAgree}})).driver);
  EXPECT_FALSE(find_twins(table_of({{1.0, Verdict::kDisagree}})).driver);
  EXPECT_FALSE(find_twins(table_of({})).driver);
}

}  // namespace
}  // namespace twincraft
