// The interval of Clopper and Pearson: closed forms, a published value, and what it promises,
// summed exactly over all outcomes.
#include "runtime/statistics/proportion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace twincraft::statistics {
namespace {

TEST(ClopperPearson, HasItsClosedFormsAtTheEnds) {
  for (const std::size_t n : {1, 10, 1000, 1000000}) {
    const auto trials = static_cast<double>(n);
    EXPECT_DOUBLE_EQ(clopper_pearson(0, n, 0.95).lower, 0.0);
    EXPECT_NEAR(clopper_pearson(0, n, 0.95).upper, 1.0 - std::pow(0.025, 1.0 / trials), 1e-12);
    EXPECT_NEAR(clopper_pearson(n, n, 0.95).lower, std::pow(0.025, 1.0 / trials), 1e-12);
    EXPECT_DOUBLE_EQ(clopper_pearson(n, n, 0.95).upper, 1.0);
  }
}

TEST(ClopperPearson, KnowsNothingWithoutTrials) {
  EXPECT_EQ(clopper_pearson(0, 0, 0.95).lower, 0.0);
  EXPECT_EQ(clopper_pearson(0, 0, 0.95).upper, 1.0);
}

/// Clopper and Pearson 1934, chart for 95 %; the digits as R's binom.test(3, 10) and (5, 20) print
/// them.
TEST(ClopperPearson, HasThePublishedValues) {
  EXPECT_NEAR(clopper_pearson(3, 10, 0.95).lower, 0.06673951, 1e-8);
  EXPECT_NEAR(clopper_pearson(3, 10, 0.95).upper, 0.65245285, 1e-8);
  EXPECT_NEAR(clopper_pearson(5, 20, 0.95).lower, 0.08657147, 1e-8);
  EXPECT_NEAR(clopper_pearson(5, 20, 0.95).upper, 0.49104587, 1e-8);
}

double binomial(std::size_t k, std::size_t n, double p) {
  const auto a = static_cast<double>(k), b = static_cast<double>(n - k);
  return std::exp(std::lgamma(a + b + 1.0) - std::lgamma(a + 1.0) - std::lgamma(b + 1.0) +
                  a * std::log(p) + b * std::log1p(-p));
}

TEST(ClopperPearson, CoversEveryProbability) {
  for (const std::size_t n : {5, 40, 300})
    for (double p = 0.005; p < 1.0; p += 0.005) {
      double covered = 0.0;
      for (std::size_t k = 0; k <= n; ++k) {
        const Interval interval = clopper_pearson(k, n, 0.95);
        if (interval.lower <= p && p <= interval.upper) covered += binomial(k, n, p);
      }
      ASSERT_GE(covered, 0.95 - 1e-9) << n << ' ' << p;
    }
}

}  // namespace
}  // namespace twincraft::statistics
