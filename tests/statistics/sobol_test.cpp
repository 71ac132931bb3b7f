// Sobol' indices of models whose indices are known: Ishigami's function and a linear one.
#include "runtime/statistics/sobol.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace twincraft::statistics {
namespace {

using Values = std::vector<double>;
using Columns = std::vector<std::span<const double>>;
using Point = std::array<double, 3>;
using Model = std::function<double(const Point&)>;

constexpr double kPi = std::numbers::pi;

/// Ishigami and Homma 1990, a = 7, b = 0.1, inputs uniform in [-pi, pi].
double ishigami(const Point& x) {
  return std::sin(x[0]) + 7.0 * std::pow(std::sin(x[1]), 2) +
         0.1 * std::pow(x[2], 4) * std::sin(x[0]);
}
double linear(const Point& x) { return 3.0 * x[0] + 2.0 * x[1] + x[2]; }

struct Known {
  std::array<double, 3> first, total;
};
Known of_ishigami() {
  const double a = 7.0, b = 0.1, p4 = std::pow(kPi, 4);
  const double one = 0.5 * std::pow(1.0 + b * p4 / 5.0, 2), two = a * a / 8.0;
  const double both = b * b * p4 * p4 * 8.0 / 225.0, all = one + two + both;
  return {{one / all, two / all, 0.0}, {(one + both) / all, two / all, both / all}};
}
Known of_linear() {
  return {{9.0 / 14.0, 4.0 / 14.0, 1.0 / 14.0}, {9.0 / 14.0, 4.0 / 14.0, 1.0 / 14.0}};
}

std::vector<Point> points(std::mt19937_64& random, std::size_t count) {
  std::uniform_real_distribution<double> uniform(-kPi, kPi);
  std::vector<Point> drawn(count);
  for (Point& point : drawn)
    for (double& x : point) x = uniform(random);
  return drawn;
}

struct Given {
  std::array<Values, 3> inputs;
  Values output;

  Given(const Model& model, std::mt19937_64& random, std::size_t count) {
    for (const Point& point : points(random, count)) {
      for (std::size_t i = 0; i < 3; ++i) inputs.at(i).push_back(point.at(i));
      output.push_back(model(point));
    }
  }
  std::optional<std::vector<Index>> indices(const Resampling& resampling = {}) const {
    const Columns columns(inputs.begin(), inputs.end());
    return sobol_given_data(columns, output, resampling);
  }
};

struct Saltelli {
  Values a, b;
  std::array<Values, 3> mixed;

  Saltelli(const Model& model, std::mt19937_64& random, std::size_t count) {
    const std::vector<Point> first = points(random, count), second = points(random, count);
    for (std::size_t row = 0; row < count; ++row) {
      a.push_back(model(first[row]));
      b.push_back(model(second[row]));
      for (std::size_t i = 0; i < 3; ++i) {
        Point point = first[row];
        point.at(i) = second[row].at(i);
        mixed.at(i).push_back(model(point));
      }
    }
  }
  std::optional<SaltelliIndices> indices(const Resampling& resampling = {}) const {
    return sobol_saltelli({a, b, {mixed.begin(), mixed.end()}}, resampling);
  }
};

TEST(SobolGivenData, FindsIshigamiWithinItsIntervals) {
  std::mt19937_64 random(18);
  const auto found = Given(ishigami, random, 4096).indices();
  ASSERT_TRUE(found.has_value());
  for (std::size_t i = 0; i < 3; ++i) {
    const double known = of_ishigami().first.at(i);
    EXPECT_NEAR((*found)[i].value, known, 0.03) << i;
    EXPECT_LE((*found)[i].lower, known) << i;
    EXPECT_GE((*found)[i].upper, known) << i;
    EXPECT_LT((*found)[i].upper - (*found)[i].lower, 0.12) << i;
  }
}

TEST(SobolSaltelli, FindsIshigamiWithinItsIntervals) {
  std::mt19937_64 random(9);
  const auto found = Saltelli(ishigami, random, 4096).indices();
  ASSERT_TRUE(found.has_value());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LE(found->first[i].lower, of_ishigami().first.at(i)) << i;
    EXPECT_GE(found->first[i].upper, of_ishigami().first.at(i)) << i;
    EXPECT_LE(found->total[i].lower, of_ishigami().total.at(i)) << i;
    EXPECT_GE(found->total[i].upper, of_ishigami().total.at(i)) << i;
    EXPECT_LT(found->total[i].upper - found->total[i].lower, 0.1) << i;
  }
}

constexpr int kCampaigns = 800;
// Of 95 %, one is what normal intervals of few members lack, and three standard deviations of the
// count are 2.5.
constexpr int kFewestCovered = static_cast<int>(0.915 * kCampaigns);

struct Coverage {
  std::array<int, 3> counts{};
  void see(const std::vector<Index>& found, const std::array<double, 3>& known) {
    for (std::size_t i = 0; i < 3; ++i)
      counts.at(i) += found[i].lower <= known.at(i) && known.at(i) <= found[i].upper ? 1 : 0;
  }
};

TEST(SobolGivenData, CoversTheIndicesAsOftenAsItSays) {
  std::mt19937_64 random(10);
  for (const auto& [model, known] :
       {std::pair{Model(ishigami), of_ishigami()}, std::pair{Model(linear), of_linear()}}) {
    Coverage covered;
    for (int i = 0; i < kCampaigns; ++i)
      covered.see(*Given(model, random, 1000).indices({100, random()}), known.first);
    EXPECT_THAT(covered.counts, testing::Each(testing::Ge(kFewestCovered)))
        << testing::PrintToString(covered.counts);
  }
}

TEST(SobolSaltelli, CoversTheIndicesAsOftenAsItSays) {
  std::mt19937_64 random(11);
  for (const auto& [model, known] :
       {std::pair{Model(ishigami), of_ishigami()}, std::pair{Model(linear), of_linear()}}) {
    Coverage first, total;
    for (int i = 0; i < kCampaigns; ++i) {
      const auto found = Saltelli(model, random, 300).indices({100, random()});
      first.see(found->first, known.first);
      total.see(found->total, known.total);
    }
    EXPECT_THAT(first.counts, testing::Each(testing::Ge(kFewestCovered)))
        << testing::PrintToString(first.counts);
    EXPECT_THAT(total.counts, testing::Each(testing::Ge(kFewestCovered)))
        << testing::PrintToString(total.counts);
  }
}

TEST(SobolGivenData, TakesAChoiceOfFewValues) {
  std::mt19937_64 random(12);
  Values coin, noise, output;
  for (int i = 0; i < 2000; ++i) {
    coin.push_back(static_cast<double>(random() % 2));
    noise.push_back(std::normal_distribution<double>()(random));
    output.push_back(2.0 * coin.back() + noise.back());  // variances 1 and 1
  }
  const Values same(2000, 3.0);
  const Columns inputs = {coin, noise, same};
  const auto found = *sobol_given_data(inputs, output);
  EXPECT_NEAR(found[0].value, 0.5, 0.04);
  EXPECT_NEAR(found[1].value, 0.5, 0.04);
  EXPECT_EQ(found[2].value, 0.0);
  EXPECT_EQ(found[2].upper, 0.0);
}

TEST(SobolGivenData, DependsNeitherOnTheOutputsUnitNorOnItsZero) {
  std::mt19937_64 random(13);
  Given given(ishigami, random, 500);
  const auto found = *given.indices();
  for (double& value : given.output) value = 1e6 + 1e-3 * value;
  const auto again = *given.indices();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(again[i].value, found[i].value, 1e-6);
    EXPECT_NEAR(again[i].lower, found[i].lower, 1e-6);
  }
}

TEST(Sobol, IsNotComputedWithAHole) {
  std::mt19937_64 random(14);
  Given given(ishigami, random, 100);
  given.output[7] = std::nan("");
  EXPECT_FALSE(given.indices().has_value());
  Given holed(ishigami, random, 100);
  holed.inputs[1][3] = std::nan("");
  EXPECT_FALSE(holed.indices().has_value());
  Saltelli design(ishigami, random, 100);
  design.mixed[2][5] = std::nan("");
  EXPECT_FALSE(design.indices().has_value());
}

TEST(Sobol, IsNotComputedOfFewMembersOrOfAConstant) {
  std::mt19937_64 random(15);
  EXPECT_FALSE(Given(ishigami, random, 15).indices().has_value());
  EXPECT_FALSE(Given([](const Point&) { return 1.0; }, random, 100).indices().has_value());
}

}  // namespace
}  // namespace twincraft::statistics
