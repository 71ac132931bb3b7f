// What drives an output of a campaign.
#include "runtime/campaign/drivers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/campaign/handmade_campaign.h"

namespace twincraft {
namespace {

const std::vector<bool> kAll(3, true);

/// Members whose output is the given one; the numbers drawn are theirs, their negative, and 1.
CampaignTable table_of(const std::vector<std::optional<double>>& outputs) {
  RecordsHeader header = test::driven_header();
  header.outputs.resize(1);
  CampaignTable table(header);
  for (std::size_t member = 0; member < outputs.size(); ++member) {
    MemberRecord record;
    record.member = member;
    record.drawn = {static_cast<double>(member), -static_cast<double>(member), 1.0};
    record.outputs = {outputs[member]};
    table.add(record);
  }
  EXPECT_EQ(table.settle(outputs.size()), "");
  return table;
}

std::vector<std::optional<double>> rising(std::size_t count) {
  std::vector<std::optional<double>> values;
  for (std::size_t i = 0; i < count; ++i) values.emplace_back(static_cast<double>(i * i));
  return values;
}

TEST(Drivers, CorrelateByRankWithTheirSign) {
  const OutputDrivers found = drivers_of(table_of(rising(5)), 0, Sampling::kRandom, kAll);
  ASSERT_EQ(found.drivers.size(), 3u);
  EXPECT_EQ(found.drivers[0].drawn, 0u);  // of equal ones the first
  EXPECT_DOUBLE_EQ(found.drivers[0].rank->coefficient, 1.0);
  EXPECT_DOUBLE_EQ(found.drivers[1].rank->coefficient, -1.0);
  EXPECT_EQ(found.drivers[2].drawn, 2u);
  EXPECT_FALSE(found.drivers[2].rank.has_value());
  EXPECT_EQ(found.drivers[2].strength(), 0.0);
}

TEST(Drivers, AreTheStrongestFirst) {
  const MergedCampaign campaign = test::driven_campaign(399);
  const OutputDrivers found = drivers_of(campaign.table, 0, Sampling::kRandom, kAll);
  EXPECT_EQ(found.drivers[0].drawn, 0u);
  EXPECT_EQ(found.drivers[1].drawn, 1u);
  EXPECT_EQ(found.drivers[2].drawn, 2u);
  EXPECT_EQ(found.no_sobol, "");
}

/// Variances: 0.01^2 of the mass, 0.02^2 * 4/45 of the square of a uniform number.
TEST(Drivers, HaveTheIndicesOfAKnownSum) {
  const MergedCampaign campaign = test::driven_campaign(399);
  const OutputDrivers found = drivers_of(campaign.table, 0, Sampling::kRandom, kAll);
  const double heavy = 1e-4, fast = 4e-4 * 4.0 / 45.0;
  const double share = heavy / (heavy + fast);
  const auto holds = [](const statistics::Index& index, double value) {
    return index.lower <= value && value <= index.upper && index.upper - index.lower < 0.3;
  };
  EXPECT_TRUE(holds(*found.drivers[0].sobol_first, share));
  EXPECT_TRUE(holds(*found.drivers[1].sobol_first, 1.0 - share));
  EXPECT_LT(std::abs(found.drivers[1].rank->coefficient), 0.15);  // a square has no rank
}

TEST(Drivers, HaveNoIndexWhereAMemberHasNoValue) {
  std::vector<std::optional<double>> outputs = rising(40);
  outputs[3].reset();
  OutputDrivers found = drivers_of(table_of(outputs), 0, Sampling::kRandom, kAll);
  EXPECT_EQ(found.no_sobol, "1 of 40 members has no value");
  EXPECT_FALSE(found.drivers[0].sobol_first.has_value());
  EXPECT_EQ(found.drivers[0].rank->count, 39u);
  const MergedCampaign campaign = test::driven_campaign(400);  // the last one failed
  found = drivers_of(campaign.table, 0, Sampling::kRandom, kAll);
  EXPECT_EQ(found.no_sobol, "1 of 400 members has no value");
  EXPECT_EQ(found.drivers[0].rank->count, 399u);
}

TEST(Drivers, HaveNoIndexOfTooFewOrOfOneValue) {
  EXPECT_EQ(drivers_of(table_of(rising(15)), 0, Sampling::kRandom, kAll).no_sobol,
            "fewer than 16 members");
  EXPECT_EQ(
      drivers_of(table_of(std::vector<std::optional<double>>(20, 1.0)), 0, Sampling::kRandom, kAll)
          .no_sobol,
      "it is the same in all members");
}

TEST(Drivers, HaveNoIndexWhereTheyDependOnOthers) {
  const CampaignTable table = table_of(rising(40));
  OutputDrivers found = drivers_of(table, 0, Sampling::kRandom, {true, false, false});
  EXPECT_EQ(found.no_sobol, "");
  EXPECT_TRUE(found.drivers[0].sobol_first.has_value());
  EXPECT_FALSE(found.drivers[1].sobol_first.has_value());
  found = drivers_of(table, 0, Sampling::kRandom, {false, false, false});
  EXPECT_EQ(found.no_sobol, "no drawn number is independent of the others");
}

TEST(Drivers, OfNoMembersAreNone) {
  const OutputDrivers found = drivers_of(table_of({}), 0, Sampling::kRandom, kAll);
  EXPECT_EQ(found.drivers.size(), 3u);
  EXPECT_FALSE(found.drivers[0].rank.has_value());
  EXPECT_EQ(found.no_sobol, "fewer than 16 members");
}

TEST(Drivers, HaveNoIndexWhereMembersAreOfASobolSequence) {
  const OutputDrivers found =
      drivers_of(table_of(std::vector<std::optional<double>>(20, 1.0)), 0, Sampling::kSobol, kAll);
  EXPECT_THAT(found.no_sobol, testing::HasSubstr("Sobol' sequence"));
  for (const Driver& driver : found.drivers) EXPECT_FALSE(driver.sobol_first);
}

}  // namespace
}  // namespace twincraft
