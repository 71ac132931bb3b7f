// The tableaux as numbers: consistency and the quadrature conditions. Their order on a nonlinear
// problem is shown in runge_kutta_test.cpp.
#include "runtime/integrate/tableau.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace twincraft {
namespace {

constexpr double kRounding = 2.0e-15;  // the entries reach 12 and up to 9 of them are added

class EveryTableau : public testing::TestWithParam<Method> {
 protected:
  const Tableau& tableau_ = tableau_of(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Tableau, EveryTableau,
                         testing::Values(Method::kEuler, Method::kRk2, Method::kRk4, Method::kRkf45,
                                         Method::kRkf78),
                         [](const auto& param_info) {
                           return std::string(tableau_of(param_info.param).name);
                         });

double sum(const Tableau::Row& row) { return std::accumulate(row.begin(), row.end(), 0.0); }

/// sum_i b_i c_i^power
double moment(const Tableau& tableau, const Tableau::Row& b, int power) {
  double total = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) total += b[i] * std::pow(tableau.c[i], power);
  return total;
}

TEST_P(EveryTableau, HasRowSumsEqualToItsStageTimes) {
  for (std::size_t i = 0; i < Tableau::kMaxStages; ++i)
    EXPECT_NEAR(sum(tableau_.a[i]), tableau_.c[i], 5.0 * kRounding) << "stage " << i + 1;
}

TEST_P(EveryTableau, IsExplicitAndEmptyBeyondItsStages) {
  for (std::size_t i = 0; i < Tableau::kMaxStages; ++i) {
    for (std::size_t j = i; j < Tableau::kMaxStages; ++j) EXPECT_EQ(tableau_.a[i][j], 0.0);
    if (i < static_cast<std::size_t>(tableau_.stages)) continue;
    EXPECT_EQ(sum(tableau_.a[i]), 0.0);
    EXPECT_EQ(tableau_.b[i], 0.0);
    EXPECT_EQ(tableau_.b_hat[i], 0.0);
  }
}

TEST_P(EveryTableau, IntegratesPowersOfTimeUpToItsOrder) {
  for (int power = 0; power < tableau_.order; ++power)
    EXPECT_NEAR(moment(tableau_, tableau_.b, power), 1.0 / (power + 1), kRounding);
}

TEST_P(EveryTableau, ComparesWithASolutionOneOrderHigher) {
  if (!tableau_.adaptive) {
    EXPECT_EQ(sum(tableau_.b_hat), 0.0);
    return;
  }
  for (int power = 0; power <= tableau_.order; ++power)
    EXPECT_NEAR(moment(tableau_, tableau_.b_hat, power), 1.0 / (power + 1), kRounding);
}

TEST(Tableau, OfAnEmbeddedPairScalesStepsByItsLowerOrderPlusOne) {
  EXPECT_EQ(kRkf45.control_exponent(), 1.0 / 5);
  EXPECT_EQ(kRkf78.control_exponent(), 1.0 / 8);
}

}  // namespace
}  // namespace twincraft
