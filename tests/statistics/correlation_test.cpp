// Rank correlation and regression: published values, exact linear models, and the frequency of
// false findings.
#include "runtime/statistics/correlation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace twincraft::statistics {
namespace {

using Values = std::vector<double>;
using Columns = std::vector<std::span<const double>>;

const double kHole = std::nan("");

/// n = 10, no ties: coefficient -29/165 (IQ and hours of television, the example of many texts), p
/// by R's cor.test(exact = FALSE).
TEST(Spearman, HasThePublishedValue) {
  const Values iq = {106, 86, 100, 101, 99, 103, 97, 113, 112, 110};
  const Values hours = {7, 0, 27, 50, 28, 29, 20, 12, 6, 17};
  const auto found = spearman(iq, hours);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->coefficient, -29.0 / 165.0, 1e-14);
  EXPECT_NEAR(found->p_value, 0.62718834, 1e-7);
  EXPECT_EQ(found->count, 10u);
}

TEST(Spearman, SharesTheRanksOfTies) {
  // Ranks 1, 2.5, 2.5, 4 and 1, 3, 2, 4: 4.5 / sqrt(4.5 * 5).
  const auto found = spearman(Values{1, 2, 2, 3}, Values{10, 30, 20, 40});
  EXPECT_NEAR(found->coefficient, 4.5 / std::sqrt(22.5), 1e-14);
}

TEST(Spearman, SeesAnyRisingLawAsOne) {
  Values x, y;
  for (int i = -20; i < 20; ++i) {
    x.push_back(i);
    y.push_back(std::exp(i));
  }
  EXPECT_DOUBLE_EQ(spearman(x, y)->coefficient, 1.0);
  EXPECT_LT(spearman(x, y)->p_value, 1e-12);
}

TEST(Spearman, LeavesPairsWithAHoleOut) {
  const auto found = spearman(Values{1, 2, kHole, 4, 5}, Values{1, 2, 3, kHole, 4});
  EXPECT_EQ(found->count, 3u);
  EXPECT_DOUBLE_EQ(found->coefficient, 1.0);
}

TEST(Spearman, SaysNothingWhereNothingVaries) {
  EXPECT_FALSE(spearman(Values{1, 2}, Values{1, 2}).has_value());
  EXPECT_FALSE(spearman(Values{1, 2, 3}, Values{4, 4, 4}).has_value());
  EXPECT_FALSE(spearman({}, {}).has_value());
}

TEST(Spearman, FindsWhatIsNotThereAsOftenAsItSays) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  constexpr int kSamples = 4000;
  int found = 0;
  for (int sample = 0; sample < kSamples; ++sample) {
    Values x(40), y(40);
    for (double& value : x) value = normal(random);
    for (double& value : y) value = normal(random);
    found += spearman(x, y)->p_value < 0.05 ? 1 : 0;
  }
  EXPECT_NEAR(found, kSamples * 0.05, 3.0 * std::sqrt(kSamples * 0.0475));
}

struct Linear {
  Values a, b, same, y;
  Linear() {
    std::mt19937_64 random(6);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 500; ++i) {
      a.push_back(1e3 + 2.0 * normal(random));
      b.push_back(normal(random));
      same.push_back(7.0);
      y.push_back(3.0 * a.back() - 8.0 * b.back() + 100.0);
    }
  }
};

double deviation(const Values& values) {
  double mean = 0.0, squares = 0.0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / (static_cast<double>(values.size()) - 1.0));
}

TEST(Regression, FindsALinearModelExactly) {
  const Linear data;
  const Columns inputs = {data.a, data.same, data.b};
  const auto found = standardised_regression(inputs, data.y);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->coefficients[0], 3.0 * deviation(data.a) / deviation(data.y), 1e-9);
  EXPECT_EQ(found->coefficients[1], 0.0);
  EXPECT_NEAR(found->coefficients[2], -8.0 * deviation(data.b) / deviation(data.y), 1e-9);
  EXPECT_NEAR(found->r_squared, 1.0, 1e-12);
  EXPECT_EQ(found->count, 500u);
}

TEST(Regression, SaysHowMuchItExplains) {
  Linear data;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0.0, 10.0);  // as large as the signal: 36 + 64
  for (double& value : data.y) value += normal(random);
  const Columns inputs = {data.a, data.b};
  EXPECT_NEAR(standardised_regression(inputs, data.y)->r_squared, 0.5, 0.1);
}

TEST(Regression, LeavesMembersWithAHoleOut) {
  Linear data;
  data.y[3] = kHole;
  data.b[5] = kHole;
  const Columns inputs = {data.a, data.b};
  const auto found = standardised_regression(inputs, data.y);
  EXPECT_EQ(found->count, 498u);
  EXPECT_NEAR(found->r_squared, 1.0, 1e-12);
}

TEST(Regression, SaysNothingOfInputsThatFollowFromOthers) {
  const Linear data;
  const Columns twice = {data.a, data.a};
  EXPECT_FALSE(standardised_regression(twice, data.y).has_value());
}

TEST(Regression, SaysNothingOfTooFewMembersOrOfAConstant) {
  const Values x = {1, 2, 3};
  const Columns inputs = {x, x};
  EXPECT_FALSE(standardised_regression(inputs, x).has_value());
  const Linear data;
  const Columns one = {data.a};
  EXPECT_FALSE(standardised_regression(one, data.same).has_value());
}

TEST(Regression, OfNoInputsExplainsNothing) {
  const auto found = standardised_regression({}, Values{1, 2, 3});
  ASSERT_TRUE(found.has_value());
  EXPECT_TRUE(found->coefficients.empty());
  EXPECT_EQ(found->r_squared, 0.0);
}

/// The permeability of membranes (Hollander and Wolfe 1973, page 69; the example of R's
/// wilcox.test): W = 35, and p by R with exact = FALSE.
TEST(RankDifference, HasThePublishedValue) {
  const Values term = {0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46};
  const Values early = {1.15, 0.88, 0.90, 0.74, 1.21};
  const auto found = rank_difference(term, early);
  ASSERT_TRUE(found.has_value());
  EXPECT_DOUBLE_EQ(found->larger, 35.0 / 50.0);
  EXPECT_NEAR(found->p_value, std::erfc(9.5 / std::sqrt(50.0 * 16.0 / 12.0) / std::sqrt(2.0)),
              1e-12);
  EXPECT_DOUBLE_EQ(rank_difference(early, term)->larger, 15.0 / 50.0);
  EXPECT_DOUBLE_EQ(rank_difference(early, term)->p_value, found->p_value);
}

TEST(RankDifference, CountsTiesHalfAndLeavesHolesOut) {
  // Pairs of {1, 2} with {1, 3}: one tie, one larger, two smaller.
  const auto found = rank_difference(Values{1, kHole, 2}, Values{kHole, 1, 3});
  EXPECT_DOUBLE_EQ(found->larger, 1.5 / 4.0);
  EXPECT_DOUBLE_EQ(found->p_value, 1.0);  // 2 - 1.5 is no more than the correction
}

TEST(RankDifference, IsNothingWithoutTwoGroupsOrWithoutADifference) {
  EXPECT_FALSE(rank_difference(Values{}, Values{1.0}));
  EXPECT_FALSE(rank_difference(Values{1.0}, Values{kHole}));
  EXPECT_FALSE(rank_difference(Values{1, 1}, Values{1}));
}

/// With this p, 5 % of groups of one distribution seem different. Ties included.
TEST(RankDifference, FindsWhatIsNotThereAsOftenAsItSays) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> roll(1, 20);
  const auto draw = [&](std::size_t count) {
    Values values(count);
    for (double& value : values) value = roll(random);
    return values;
  };
  int found = 0;
  constexpr int kTrials = 4000;
  for (int i = 0; i < kTrials; ++i) found += rank_difference(draw(12), draw(40))->p_value < 0.05;
  EXPECT_NEAR(found / static_cast<double>(kTrials), 0.05, 0.012);
}

}  // namespace
}  // namespace twincraft::statistics
