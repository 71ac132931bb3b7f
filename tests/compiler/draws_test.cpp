// Claims about drawn numbers: they are the published ones where there are any, they follow their
// distributions, and each depends on nothing but its seed, its member and its name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>

#include "compiler/components/physical.h"
#include "compiler/draws/arithmetic.h"
#include "compiler/draws/copula.h"
#include "compiler/draws/distribution.h"
#include "compiler/draws/normal.h"
#include "compiler/draws/philox.h"
#include "compiler/draws/sampler.h"
#include "compiler/draws/solid.h"

namespace twincraft::draws {
namespace {

using testing::Each;
using testing::ElementsAre;

constexpr double kUlp = std::numeric_limits<double>::epsilon();
constexpr std::size_t kMany = 20'000;

std::vector<double> uniforms(Sampling sampling, std::size_t count, const std::string& name = "x",
                             std::uint64_t seed = 7) {
  const Sampler sampler(sampling, seed, count, {name});
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(sampler.uniform(i, 0));
  return numbers;
}

std::vector<double> drawn(const Distribution& distribution, std::size_t count = kMany) {
  std::vector<double> numbers = uniforms(Sampling::kRandom, count);
  for (double& number : numbers) number = value_of(distribution, number);
  return numbers;
}

double mean_of(const std::vector<double>& numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(numbers.size());
}

double deviation_of(const std::vector<double>& numbers) {
  const double mean = mean_of(numbers);
  double sum = 0.0;
  for (const double number : numbers) sum += (number - mean) * (number - mean);
  return std::sqrt(sum / static_cast<double>(numbers.size()));
}

double correlation_of(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = mean_of(a), mean_b = mean_of(b);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - mean_a) * (b[i] - mean_b);
  return sum / static_cast<double>(a.size()) / deviation_of(a) / deviation_of(b);
}

/// Kolmogorov and Smirnov: the largest distance of the empirical distribution from `cdf`, times the
/// root of the count. A true one is above 1.95 once in a thousand samples.
double ks(std::vector<double> numbers, const std::function<double(double)>& cdf) {
  std::ranges::sort(numbers);
  const auto n = static_cast<double>(numbers.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double value = cdf(numbers[i]);
    largest = std::max(
        {largest, static_cast<double>(i + 1) / n - value, value - static_cast<double>(i) / n});
  }
  return largest * std::sqrt(n);
}

constexpr double kKsLimit = 1.95;

double exact_cdf(double x) { return std::erfc(-x / std::sqrt(2.0)) / 2.0; }

TEST(Philox, GivesThePublishedNumbers) {
  // kat_vectors of Random123.
  EXPECT_THAT(philox({0, 0, 0, 0}, {0, 0}), ElementsAre(0x16554d9eca36314c, 0xdb20fe9d672d0fdc,
                                                        0xd7e772cee186176b, 0x7e68b68aec7ba23b));
  constexpr std::uint64_t kAll = ~std::uint64_t{0};
  EXPECT_THAT(
      philox({kAll, kAll, kAll, kAll}, {kAll, kAll}),
      ElementsAre(0x87b092c3013fe90b, 0x438c3c67be8d0224, 0x9cc7d7c69cd777b6, 0xa09caebf594f0ba0));
  EXPECT_THAT(
      philox({0x243f6a8885a308d3, 0x13198a2e03707344, 0xa4093822299f31d0, 0x082efa98ec4e6c89},
             {0x452821e638d01377, 0xbe5466cf34e90c6c}),
      ElementsAre(0xa528f45403e61d95, 0x38c72dbd566e9788, 0xa5a1610e72fd18b5, 0x57bd43b5e52b7fe6));
}

TEST(UnitNumbers, AreNeverZeroNorOne) {
  EXPECT_EQ(unit_number(0), 0x1p-53);
  EXPECT_EQ(unit_number(~std::uint64_t{0}), 1.0 - 0x1p-53);
}

TEST(Arithmetic, IsThatOfTheLibraryButForTheLastDigits) {
  for (double x = 1.0e-300; x < 1.0e300; x *= 1.37)
    EXPECT_NEAR(natural_logarithm(x), std::log(x),
                4.0 * kUlp * std::max(std::abs(std::log(x)), std::abs(x - 1.0) < 0.5 ? 0.0 : 1.0))
        << x;
  for (double x = -690.0; x < 690.0; x += 0.731)
    EXPECT_NEAR(exponential(x) / std::exp(x), 1.0, 4.0 * kUlp) << x;
  for (double x = -20.0; x < 20.0; x += 0.0137) {
    EXPECT_NEAR(sine_cosine(x).sine, std::sin(x), 4.0 * kUlp) << x;
    EXPECT_NEAR(sine_cosine(x).cosine, std::cos(x), 4.0 * kUlp) << x;
  }
  EXPECT_EQ(exponential(0.0), 1.0);
  EXPECT_EQ(natural_logarithm(1.0), 0.0);
  EXPECT_EQ(exponential(-1000.0), 0.0);
}

TEST(TheNormalDistribution, IsThatOfTheErrorFunction) {
  for (double x = -37.0; x < 9.0; x += 0.0173)
    EXPECT_NEAR(normal_cdf(x), exact_cdf(x), 1.0e-15) << x;
  EXPECT_EQ(normal_cdf(0.0), 0.5);
  EXPECT_EQ(normal_cdf(-100.0), 0.0);
  EXPECT_EQ(normal_cdf(100.0), 1.0);
}

TEST(TheNormalQuantile, UndoesTheDistribution) {
  EXPECT_EQ(normal_quantile(0.5), 0.0);
  EXPECT_NEAR(normal_quantile(0.975) / 1.95996398454005423552, 1.0, 4.0 * kUlp);
  EXPECT_NEAR(normal_quantile(1.0e-20) / -9.26234008979840737, 1.0, 4.0 * kUlp);
  for (double p = 1.0e-300; p < 0.5; p *= 1.7)
    EXPECT_NEAR(exact_cdf(normal_quantile(p)) / p, 1.0, 1.0e-12) << p;
  for (double p = 0.001; p < 0.9995; p += 0.001)
    EXPECT_NEAR(exact_cdf(normal_quantile(p)), p, 1.0e-15) << p;
}

TEST(RandomSampling, IsUniform) {
  EXPECT_LT(ks(uniforms(Sampling::kRandom, kMany), [](double x) { return x; }), kKsLimit);
}

TEST(RandomSampling, DependsOnSeedMemberAndNameAlone) {
  const Sampler few(Sampling::kRandom, 7, 10, {"hub.mass"});
  const Sampler many(Sampling::kRandom, 7, 1000, {"added", "hub.mass"});
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(few.uniform(i, 0), many.uniform(i, 1));
  EXPECT_NE(few.uniform(0, 0), Sampler(Sampling::kRandom, 8, 10, {"hub.mass"}).uniform(0, 0));
}

TEST(RandomSampling, ColumnsAndSeedsAreIndependent) {
  const std::vector<double> x = uniforms(Sampling::kRandom, kMany);
  // Five standard deviations of a correlation of independent numbers.
  const double limit = 5.0 / std::sqrt(static_cast<double>(kMany));
  EXPECT_LT(std::abs(correlation_of(x, uniforms(Sampling::kRandom, kMany, "y"))), limit);
  EXPECT_LT(std::abs(correlation_of(x, uniforms(Sampling::kRandom, kMany, "x", 8))), limit);
}

TEST(LatinHypercubes, TakeEveryStratumOnce) {
  for (const std::size_t n : {1, 2, 3, 5, 16, 17, 100, 1023, 1024, 1025, 4097}) {
    std::vector<int> strata(n, 0);
    for (const double u : uniforms(Sampling::kLatinHypercube, n)) {
      ASSERT_GT(u, 0.0);
      ASSERT_LT(u, 1.0);
      strata[static_cast<std::size_t>(u * static_cast<double>(n))] += 1;
    }
    EXPECT_THAT(strata, Each(1)) << n;
  }
}

TEST(LatinHypercubes, StayInTheirStrataAtTheirLargest) {
  constexpr std::size_t kMembers = 1'000'000;
  const Sampler sampler(Sampling::kLatinHypercube, 1, kMembers, {"x"});
  const Key key = key_of(1, "x");
  for (std::size_t i = 0; i < kMembers; i += 997)
    EXPECT_EQ(static_cast<std::uint64_t>(sampler.uniform(i, 0) * kMembers),
              permuted(i, kMembers, key));
}

TEST(LatinHypercubes, ColumnsAreIndependent) {
  constexpr std::size_t kCount = 4096;
  const double limit = 5.0 / std::sqrt(static_cast<double>(kCount));
  EXPECT_LT(std::abs(correlation_of(uniforms(Sampling::kLatinHypercube, kCount, "x"),
                                    uniforms(Sampling::kLatinHypercube, kCount, "y"))),
            limit);
}

TEST(APermutation, OfFewIsAnyOfThem) {
  // All 24 orders of four, none of them rare: over 2400 keys each is expected 100 times.
  std::map<std::array<std::uint64_t, 4>, int> orders;
  for (std::uint64_t seed = 0; seed < 2400; ++seed) {
    const Key key = key_of(seed, "x");
    orders[{permuted(0, 4, key), permuted(1, 4, key), permuted(2, 4, key), permuted(3, 4, key)}] +=
        1;
  }
  EXPECT_EQ(orders.size(), 24u);
}

TEST(Sobol, IsThePublishedSequenceBeforeItsScramble) {
  const SobolSequence sequence(3);
  const auto point = [&](std::size_t i) {
    std::vector<double> x;
    for (std::size_t column = 0; column < 3; ++column)
      x.push_back(static_cast<double>(sequence.at(i, column)) * 0x1p-64);
    return x;
  };
  // Of Joe and Kuo, new-joe-kuo-6, in the order of Gray codes.
  EXPECT_THAT(point(0), ElementsAre(0.0, 0.0, 0.0));
  EXPECT_THAT(point(1), ElementsAre(0.5, 0.5, 0.5));
  EXPECT_THAT(point(2), ElementsAre(0.75, 0.25, 0.25));
  EXPECT_THAT(point(3), ElementsAre(0.25, 0.75, 0.75));
  EXPECT_THAT(point(4), ElementsAre(0.375, 0.375, 0.625));
  EXPECT_THAT(point(5), ElementsAre(0.875, 0.875, 0.125));
  EXPECT_THAT(point(6), ElementsAre(0.625, 0.125, 0.875));
  EXPECT_THAT(point(7), ElementsAre(0.125, 0.625, 0.375));
}

TEST(Sobol, StaysBalancedUnderItsScramble) {
  // The first two columns are a (0, m, 2)-net: of 256 points each of the elementary boxes of volume
  // 1/256, whatever its shape, has one.
  const Sampler sampler(Sampling::kSobol, 3, 256, {"a", "b"});
  for (int wide = 0; wide <= 8; ++wide) {
    const double across = std::ldexp(1.0, wide), along = std::ldexp(1.0, 8 - wide);
    std::set<std::pair<int, int>> boxes;
    for (std::size_t i = 0; i < 256; ++i)
      boxes.emplace(static_cast<int>(sampler.uniform(i, 0) * across),
                    static_cast<int>(sampler.uniform(i, 1) * along));
    EXPECT_EQ(boxes.size(), 256u) << wide;
  }
}

TEST(Sobol, IsUniformAndItsPointsAreAnywhere) {
  // As a sequence far more even than random numbers, and a single point uniform over the seeds.
  EXPECT_LT(ks(uniforms(Sampling::kSobol, kMany), [](double x) { return x; }), 0.1);
  std::vector<double> point;
  for (std::uint64_t seed = 0; seed < 4000; ++seed)
    point.push_back(Sampler(Sampling::kSobol, seed, 8, {"x"}).uniform(5, 0));
  EXPECT_LT(ks(point, [](double x) { return x; }), kKsLimit);
}

TEST(Sobol, KeepsItsPointsWhenMembersAreAdded) {
  const Sampler few(Sampling::kSobol, 1, 10, {"a", "b"});
  const Sampler many(Sampling::kSobol, 1, 1000, {"a", "b", "c"});
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(few.uniform(i, 1), many.uniform(i, 1));
}

TEST(Sobol, HasAllOfItsDimensions) {
  EXPECT_EQ(SobolSequence::kMostColumns, 3667u);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < SobolSequence::kMostColumns; ++i) names.push_back(std::to_string(i));
  const Sampler sampler(Sampling::kSobol, 1, 64, names);
  double sum = 0.0;
  for (std::size_t i = 0; i < 64; ++i) sum += sampler.uniform(i, names.size() - 1) / 64.0;
  EXPECT_NEAR(sum, 0.5, 1.0 / 64.0);  // one in each of 64 strata
}

/// The root mean square error, over seeds, of the mean of a smooth function of four numbers.
double error_of_mean(Sampling sampling, std::size_t members) {
  constexpr int kSeeds = 16;
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Sampler sampler(sampling, seed, members, {"a", "b", "c", "d"});
    double mean = 0.0;
    for (std::size_t i = 0; i < members; ++i) {
      double product = 1.0;
      for (std::size_t column = 0; column < 4; ++column)
        product *= 1.0 + 0.5 * (sampler.uniform(i, column) - 0.5);
      mean += product / static_cast<double>(members);
    }
    sum += (mean - 1.0) * (mean - 1.0) / kSeeds;
  }
  return std::sqrt(sum);
}

double rate_of(Sampling sampling) {
  return std::log2(error_of_mean(sampling, 64) / error_of_mean(sampling, 4096)) / 6.0;
}

TEST(Sobol, ConvergesFasterThanRandomNumbers) {
  EXPECT_GT(rate_of(Sampling::kSobol), 0.8);
  EXPECT_NEAR(rate_of(Sampling::kRandom), 0.5, 0.1);
}

TEST(NormalDraws, HaveTheirMeanAndDeviation) {
  const std::vector<double> x = drawn(Normal{600.0, 12.0});
  EXPECT_LT(ks(x, [](double v) { return exact_cdf((v - 600.0) / 12.0); }), kKsLimit);
  EXPECT_NEAR(mean_of(x), 600.0, 5.0 * 12.0 / std::sqrt(static_cast<double>(kMany)));
  EXPECT_NEAR(deviation_of(x), 12.0, 5.0 * 12.0 / std::sqrt(2.0 * kMany));
}

TEST(NormalDraws, AreTruncatedWithoutRejection) {
  const Normal truncated{10.0, 2.0, 1.5};
  const double below = exact_cdf(-1.5);
  const std::vector<double> x = drawn(truncated);
  EXPECT_LT(
      ks(x,
         [below](double v) { return (exact_cdf((v - 10.0) / 2.0) - below) / (1.0 - 2.0 * below); }),
      kKsLimit);
  EXPECT_GE(std::ranges::min(x), 7.0);
  EXPECT_LE(std::ranges::max(x), 13.0);
  EXPECT_LT(value_of(truncated, 0.2), value_of(truncated, 0.3));
  EXPECT_EQ(value_of(truncated, 0.5), 10.0);
}

TEST(UniformDraws, FillTheirRange) {
  EXPECT_LT(ks(drawn(Uniform{-3.0, 5.0}), [](double v) { return (v + 3.0) / 8.0; }), kKsLimit);
}

TEST(LognormalDraws, HaveTheMeanAndDeviationOfTheValue) {
  const std::vector<double> x = drawn(Lognormal{50.0, 20.0});
  const double variance = std::log(1.0 + 0.16);
  EXPECT_LT(ks(x,
               [variance](double v) {
                 return exact_cdf((std::log(v / 50.0) + variance / 2.0) / std::sqrt(variance));
               }),
            kKsLimit);
  EXPECT_NEAR(mean_of(x), 50.0, 5.0 * 20.0 / std::sqrt(static_cast<double>(kMany)));
  EXPECT_NEAR(deviation_of(x), 20.0, 1.0);
  EXPECT_LT(value_of(Lognormal{-50.0, 20.0}, 0.3), 0.0);
}

TEST(TriangularDraws, RiseToTheirModeAndFall) {
  const auto cdf = [](double v) {
    return v <= 2.0 ? (v - 1.0) * (v - 1.0) / 5.0 : 1.0 - (6.0 - v) * (6.0 - v) / 20.0;
  };
  EXPECT_LT(ks(drawn(Triangular{1.0, 6.0, 2.0}), cdf), kKsLimit);
  EXPECT_EQ(value_of(Triangular{4.0, 4.0, 4.0}, 0.3), 4.0);
}

TEST(Choices, AreEquallyLikely) {
  std::map<double, int> counts;
  for (const double value : drawn(Choice{{1.0, 2.0, 4.0}}, 9000)) counts[value] += 1;
  // Five standard deviations of a binomial count.
  for (const auto& [value, count] : counts) EXPECT_NEAR(count, 3000, 5.0 * std::sqrt(2000.0));
  EXPECT_EQ(counts.size(), 3u);
}

TEST(ACopula, CorrelatesTheNormalNumbersAndKeepsTheDistributions) {
  const std::optional<Copula> copula = Copula::of({{2, 0, 0.8}, {0, 3, -0.5}});
  ASSERT_TRUE(copula);
  const Sampler sampler(Sampling::kRandom, 7, kMany, {"a", "b", "c", "d"});
  std::array<std::vector<double>, 4> normals;
  std::vector<double> last;
  for (std::size_t i = 0; i < kMany; ++i) {
    std::vector<double> numbers;
    for (std::size_t column = 0; column < 4; ++column)
      numbers.push_back(sampler.uniform(i, column));
    copula->apply(numbers);
    EXPECT_EQ(numbers[1], sampler.uniform(i, 1));
    for (std::size_t column = 0; column < 4; ++column)
      normals[column].push_back(normal_quantile(numbers[column]));
    last.push_back(numbers[3]);
  }
  EXPECT_NEAR(correlation_of(normals[0], normals[2]), 0.8, 0.02);
  EXPECT_NEAR(correlation_of(normals[0], normals[3]), -0.5, 0.03);
  EXPECT_NEAR(correlation_of(normals[2], normals[3]), 0.0, 0.04);
  EXPECT_NEAR(correlation_of(normals[1], normals[2]), 0.0, 0.04);
  EXPECT_LT(ks(last, [](double x) { return x; }), kKsLimit);
}

TEST(ACopula, RefusesWhatCannotBe) {
  EXPECT_FALSE(Copula::of({{0, 1, 0.9}, {1, 2, 0.9}, {0, 2, -0.9}}));
  EXPECT_FALSE(Copula::of({{0, 1, 1.0}}));
  EXPECT_TRUE(Copula::of({{0, 1, 0.9}, {1, 2, 0.9}, {0, 2, 0.7}}));
}

TEST(Rotations, AreThoseOfEigen) {
  for (const Vector3d& turn :
       {Vector3d(0.1, -0.2, 0.3), Vector3d(1e-9, 0, 0), Vector3d(3, 2, -4), Vector3d(0, 0, 0)}) {
    const double angle = turn.norm();
    const Quaterniond expected(
        Eigen::AngleAxisd(angle, angle > 0.0 ? Vector3d(turn / angle) : Vector3d::UnitX()));
    EXPECT_NEAR((rotation_of(turn).coeffs() - expected.coeffs()).norm(), 0.0, 8.0 * kUlp);
  }
}

TEST(Cones, TiltByTheirNormalsAlongTwoDirections) {
  const Vector3d axis = Vector3d(1.0, -2.0, 0.5).normalized();
  EXPECT_EQ(tilted(axis, {0.0, 0.0}), axis);
  const Vector3d drawn = tilted(axis, {0.03, 0.04});
  EXPECT_NEAR(drawn.norm(), 1.0, 2.0 * kUlp);
  EXPECT_NEAR(std::acos(drawn.dot(axis)), 0.05, 1.0e-14);
  const Vector3d a = tilted(axis, {0.1, 0.0}) - axis * std::cos(0.1);
  const Vector3d b = tilted(axis, {0.0, 0.1}) - axis * std::cos(0.1);
  EXPECT_NEAR(a.dot(b), 0.0, 1.0e-16);
}

/// Draws of an inertia with 10 % and a tilt, and whether each is some body's.
void expect_physical(const Matrix3d& inertia, std::size_t count, double tilt) {
  const Sampler sampler(Sampling::kRandom, 7, count, {"0", "1", "2", "3", "4", "5"});
  for (std::size_t i = 0; i < count; ++i) {
    Vector3d factors, turn;
    for (int k = 0; k < 3; ++k) {
      const auto column = static_cast<std::size_t>(k);
      factors[k] = lognormal_factor(0.1, sampler.uniform(i, column));
      turn[k] = tilt * normal_quantile(sampler.uniform(i, column + 3));
    }
    const Physicality fate = physicality(spread(inertia, factors, turn));
    // A plate is on the edge of the triangle inequality, and so is all that becomes of it.
    ASSERT_TRUE(fate == Physicality::kPhysical || fate == Physicality::kOnEdge) << i;
  }
}

TEST(Inertias, ArePhysicalInEveryDraw) {
  expect_physical(Vector3d(400.0, 380.0, 360.0).asDiagonal(), 50'000, 0.02);
  expect_physical(Vector3d(100.0, 100.0, 195.0).asDiagonal(), 50'000, 0.02);
  expect_physical(Vector3d(100.0, 100.0, 200.0).asDiagonal(), 5'000, 0.3);
  Matrix3d slanted;
  slanted << 400, 10, -20, 10, 380, 5, -20, 5, 360;
  expect_physical(slanted, 5'000, 0.02);
}

TEST(Inertias, SpreadAsSaid) {
  const Vector3d moments(400.0, 380.0, 360.0);
  const Vector3d second = Vector3d::Constant(moments.sum() / 2.0) - moments;
  const Sampler sampler(Sampling::kRandom, 7, kMany, {"0", "1", "2"});
  std::array<std::vector<double>, 3> drawn;
  for (std::size_t i = 0; i < kMany; ++i) {
    const Vector3d factors(lognormal_factor(0.1, sampler.uniform(i, 0)),
                           lognormal_factor(0.1, sampler.uniform(i, 1)),
                           lognormal_factor(0.1, sampler.uniform(i, 2)));
    const Matrix3d I = spread(moments.asDiagonal(), factors, Vector3d::Zero());
    for (int k = 0; k < 3; ++k) drawn[static_cast<std::size_t>(k)].push_back(I(k, k));
    EXPECT_EQ(I(0, 1), 0.0);
  }
  for (int k = 0; k < 3; ++k) {
    const std::vector<double>& moment = drawn[static_cast<std::size_t>(k)];
    const double sigma = 0.1 * std::hypot(second[(k + 1) % 3], second[(k + 2) % 3]);
    EXPECT_NEAR(mean_of(moment), moments[k], 5.0 * sigma / std::sqrt(static_cast<double>(kMany)));
    EXPECT_NEAR(deviation_of(moment) / sigma, 1.0, 0.05);
  }
}

TEST(Inertias, StayTheNominalOneWithoutSpread) {
  Matrix3d slanted;
  slanted << 400, 10, -20, 10, 380, 5, -20, 5, 360;
  EXPECT_LT((spread(slanted, Vector3d::Ones(), Vector3d::Zero()) - slanted).norm(), 1.0e-12 * 400);
}

}  // namespace
}  // namespace twincraft::draws
