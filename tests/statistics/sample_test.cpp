// Numbers of samples, by hand, from published tables, and by drawing many samples of a distribution
// that is known.
#include "runtime/statistics/sample.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace twincraft::statistics {
namespace {

using testing::ElementsAre;

const double kHole = std::nan("");

/// Rising; their p-quantile is p.
std::vector<double> uniform_sample(std::mt19937_64& random, std::size_t count) {
  std::uniform_real_distribution<double> uniform;
  std::vector<double> values(count);
  for (double& value : values) value = uniform(random);
  return sorted(values);
}

TEST(Sample, IsSortedWithoutItsHoles) {
  EXPECT_THAT(sorted(std::vector{3.0, kHole, -1.0, 2.0}), ElementsAre(-1.0, 2.0, 3.0));
}

TEST(Moments, AreThoseOfTheTextbook) {
  const Moments found = moments(std::vector{2.0, 4.0, kHole, 4.0, 5.0, 10.0});
  EXPECT_EQ(found.count, 5u);
  EXPECT_DOUBLE_EQ(found.mean, 5.0);
  EXPECT_DOUBLE_EQ(found.deviation, 3.0);  // squares about the mean: 9 + 1 + 1 + 0 + 25
  // Sum of cubes 96: sqrt(20)/3 * (96/5) / 7.2^1.5
  EXPECT_NEAR(found.skewness, std::sqrt(20.0) / 3.0 * 19.2 / std::pow(7.2, 1.5), 1e-14);
}

TEST(Moments, KeepTheirDigitsFarFromZero) {
  const Moments found = moments(std::vector{1e9 + 1.0, 1e9 + 2.0, 1e9 + 3.0});
  EXPECT_DOUBLE_EQ(found.deviation, 1.0);
  EXPECT_NEAR(found.skewness, 0.0, 1e-12);
}

TEST(Moments, AreNotNumbersWhereTheyDoNotExist) {
  EXPECT_TRUE(std::isnan(moments({}).mean));
  EXPECT_TRUE(std::isnan(moments(std::vector{1.0}).deviation));
  EXPECT_EQ(moments(std::vector{1.0, 1.0}).deviation, 0.0);
  EXPECT_TRUE(std::isnan(moments(std::vector{1.0, 2.0}).skewness));
  EXPECT_TRUE(std::isnan(moments(std::vector{1.0, 1.0, 1.0}).skewness));
}

TEST(Quantile, LiesOnTheLineBetweenValues) {
  const std::vector<double> values = {1.0, 2.0, 4.0, 8.0};
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  EXPECT_EQ(quantile(values, 0.5), 3.0);
  EXPECT_NEAR(quantile(values, 0.95), 7.4, 1e-12);
  EXPECT_EQ(quantile(values, 1.0), 8.0);
  EXPECT_EQ(quantile(std::vector{5.0}, 0.3), 5.0);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

/// Conover, Practical Nonparametric Statistics, and NIST: with these ranks the binomial sums are
/// 0.9785 (10 values, ranks 2 and 9) and 0.9586 (20 values, ranks 6 and 15).
TEST(QuantileBounds, OfTheMedianHaveThePublishedRanks) {
  std::vector<double> ranks(20);
  std::iota(ranks.begin(), ranks.end(), 1.0);
  const Bounds twenty = quantile_bounds(ranks, 0.5, 0.95);
  EXPECT_EQ(twenty.lower, 6.0);
  EXPECT_EQ(twenty.upper, 15.0);
  const Bounds ten = quantile_bounds({ranks.data(), 10}, 0.5, 0.95);
  EXPECT_EQ(ten.lower, 2.0);
  EXPECT_EQ(ten.upper, 9.0);
}

TEST(QuantileBounds, AreMissingWhereThereAreTooFewValues) {
  std::vector<double> ranks(100);
  std::iota(ranks.begin(), ranks.end(), 1.0);
  const Bounds bounds = quantile_bounds(ranks, 0.99, 0.95);
  EXPECT_EQ(bounds.upper, std::nullopt);
  EXPECT_TRUE(bounds.lower.has_value());
  EXPECT_EQ(quantile_bounds({}, 0.5, 0.95).lower, std::nullopt);
}

TEST(QuantileBounds, CoverTheQuantileAsOftenAsTheySay) {
  std::mt19937_64 random(2);
  for (const double p : {0.5, 0.95})
    for (const std::size_t n : {100, 400}) {
      constexpr int kSamples = 4000;
      int covered = 0;
      for (int i = 0; i < kSamples; ++i) {
        const Bounds bounds = quantile_bounds(uniform_sample(random, n), p, 0.9);
        covered += bounds.lower.value_or(0.0) <= p && p <= bounds.upper.value_or(1.0) ? 1 : 0;
      }
      // Three standard deviations of the count; ranks are whole, so there may be more.
      EXPECT_GE(covered, kSamples * 0.9 - 3.0 * std::sqrt(kSamples * 0.09)) << p << ' ' << n;
      EXPECT_LE(covered, kSamples * 0.975) << p << ' ' << n;
    }
}

/// NUREG/CR-6150 and many others.
TEST(WilksNumber, IsThatOfTheTables) {
  EXPECT_EQ(wilks_number(0.95, 0.95), 59u);
  EXPECT_EQ(wilks_number(0.95, 0.95, 2), 93u);
  EXPECT_EQ(wilks_number(0.95, 0.95, 3), 124u);
  EXPECT_EQ(wilks_number(0.95, 0.99), 90u);
  EXPECT_EQ(wilks_number(0.99, 0.95), 299u);
  EXPECT_EQ(wilks_number(0.9973, 0.90), 852u);
  EXPECT_EQ(wilks_number(0.9973, 0.95), 1109u);
  EXPECT_EQ(wilks_number(0.5, 0.5), 1u);
}

TEST(ToleranceBound, TakesTheRankThatTheNumberOfValuesAllows) {
  std::vector<double> ranks(200);
  std::iota(ranks.begin(), ranks.end(), 1.0);
  const auto of = [&](std::size_t n) { return tolerance_bound({ranks.data(), n}, 0.95, 0.95); };
  EXPECT_FALSE(of(58).has_value());
  EXPECT_EQ(of(59)->value, 59.0);
  EXPECT_EQ(of(92)->rank, 1u);
  EXPECT_EQ(of(93)->rank, 2u);
  EXPECT_EQ(of(93)->value, 92.0);
  EXPECT_EQ(of(124)->rank, 3u);
  EXPECT_FALSE(tolerance_bound({}, 0.95, 0.95).has_value());
}

TEST(ToleranceBound, IsAboveTheShareAsOftenAsItSays) {
  std::mt19937_64 random(3);
  for (const std::size_t n : {59, 150}) {
    constexpr int kSamples = 4000;
    int above = 0;
    for (int i = 0; i < kSamples; ++i)
      above += tolerance_bound(uniform_sample(random, n), 0.95, 0.95)->value >= 0.95 ? 1 : 0;
    EXPECT_GE(above, kSamples * 0.95 - 3.0 * std::sqrt(kSamples * 0.0475)) << n;
    EXPECT_LE(above, kSamples * 0.99) << n;
  }
}

TEST(Distribution, HasAStepPerDistinctValue) {
  const std::vector<Step> steps = distribution(std::vector{1.0, 1.0, 2.0, 5.0}, 10);
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(steps[0].value, 1.0);
  EXPECT_EQ(steps[0].share, 0.5);
  EXPECT_EQ(steps[1].share, 0.75);
  EXPECT_EQ(steps[2].value, 5.0);
  EXPECT_EQ(steps[2].share, 1.0);
  EXPECT_TRUE(distribution({}, 10).empty());
}

TEST(Distribution, IsThinnedWithoutLosingItsShape) {
  std::mt19937_64 random(4);
  const std::vector<double> values = uniform_sample(random, 10000);
  const std::vector<Step> all = distribution(values, 10000);
  ASSERT_EQ(all.size(), values.size());
  for (const std::size_t most : {2, 3, 50, 256}) {
    const std::vector<Step> thinned = distribution(values, most);
    ASSERT_LE(thinned.size(), most);
    EXPECT_EQ(thinned.front().value, values.front());
    EXPECT_EQ(thinned.back().value, values.back());
    std::size_t at = 0;
    for (const Step& step : all) {
      while (at + 1 < thinned.size() && thinned[at + 1].value <= step.value) ++at;
      ASSERT_LE(std::abs(step.share - thinned[at].share),
                1.0 / static_cast<double>(most - 1) + 1e-12);
    }
  }
}

}  // namespace
}  // namespace twincraft::statistics
