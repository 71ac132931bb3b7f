// What a method does to a mode, and what follows for a step. The numbers are those of the methods'
// stability functions, worked out by hand from their series.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "runtime/linear/advice.h"
#include "runtime/linear/amplification.h"
#include "runtime/linear/motion_record.h"
#include "tests/runtime/handmade.h"

namespace twincraft {
namespace {

using testing::DoubleNear;
using testing::HasSubstr;

/// exp(z) cut after z^order.
Complex cut_exponential(Complex z, int order) {
  Complex term = 1.0, sum = 1.0;
  for (int n = 1; n <= order; ++n) sum += term *= z / static_cast<double>(n);
  return sum;
}

TEST(Amplification, IsTheExponentialCutAtTheOrderOfTheMethod) {
  const Complex z(-0.4, 1.3);
  EXPECT_LT(std::abs(amplification(kEuler, z) - cut_exponential(z, 1)), 1.0e-15);
  EXPECT_LT(std::abs(amplification(kRk2, z) - cut_exponential(z, 2)), 1.0e-15);
  EXPECT_LT(std::abs(amplification(kRk4, z) - cut_exponential(z, 4)), 1.0e-15);
}

TEST(Amplification, HasTheExtraTermsOfTheEmbeddedPairs) {
  const Complex z(-0.2, 0.9);
  const Complex z5 = std::pow(z, 5), z8 = std::pow(z, 8);
  EXPECT_LT(std::abs(amplification(kRkf45, z) - cut_exponential(z, 4) - z5 / 104.0), 1.0e-14);
  const Complex tail =
      z8 * (269.0 / 11612160.0 +
            z * (4453.0 / 1881169920.0 + z * (13.0 / 250822656.0 - z * 65.0 / 1504935936.0)));
  EXPECT_LT(std::abs(amplification(kRkf78, z) - cut_exponential(z, 7) - tail), 1.0e-14);
}

TEST(StabilityLimit, IsThatOfTheTextbooksOnTheRealAndImaginaryAxes) {
  // |R| <= 1.001 lies a little beyond |R| = 1.
  EXPECT_THAT(stability_limit(kEuler, -1.0), DoubleNear(2.0, 2.0e-3));
  EXPECT_THAT(stability_limit(kRk2, -3.0), DoubleNear(2.0, 2.0e-3));
  EXPECT_THAT(stability_limit(kRk4, -1.0), DoubleNear(2.7853, 2.0e-3));
  EXPECT_THAT(stability_limit(kRkf45, -1.0), DoubleNear(3.0200, 2.0e-3));
  EXPECT_THAT(stability_limit(kRkf78, -1.0), DoubleNear(5.0362, 2.0e-3));
  EXPECT_THAT(stability_limit(kRk4, Complex(0.0, 7.0)), DoubleNear(2.8284, 2.0e-3));
}

TEST(StabilityLimit, FollowsTheDampingRatio) {
  const auto at = [](const Tableau& tableau, double zeta) {
    return stability_limit(tableau, Complex(-zeta, std::sqrt(1.0 - zeta * zeta)));
  };
  EXPECT_THAT(at(kRk2, 0.1), DoubleNear(1.05, 0.01));
  EXPECT_THAT(at(kRk4, 0.1), DoubleNear(2.95, 0.01));
  EXPECT_THAT(at(kRk4, 0.5), DoubleNear(2.62, 0.01));
  EXPECT_THAT(at(kRkf78, 0.5), DoubleNear(4.65, 0.01));
}

TEST(ModeError, IsThatOfTheStepsThemselves) {
  // An undamped oscillator by rk4 at five steps a radian, for two hundred radians.
  const Complex s(0.0, 1.0);
  const double h = 0.2, duration = 200.0;
  Complex found = 1.0;
  double worst = 0.0;
  for (int n = 1; n <= 1000; ++n) {
    found *= amplification(kRk4, h * s);
    worst = std::max(worst, std::abs(found - std::exp(n * h * s)));
  }
  EXPECT_NEAR(mode_error(kRk4, s, h, duration), worst, 1.0e-9);
}

TEST(ModeError, GrowsWithPhaseOverManyPeriods) {
  // Steps per radian for 5 % after so many periods.
  const auto error = [](double y, double periods) {
    return mode_error(kRk4, Complex(0.0, 1.0), y, periods * 2.0 * 3.14159265358979);
  };
  EXPECT_NEAR(error(0.31, 100.0), 0.05, 0.01);
  EXPECT_NEAR(error(0.097, 1.0e4), 0.05, 0.01);
}

TEST(ModeError, DividesTrueGrowthOut) {
  EXPECT_LT(mode_error(kRk4, Complex(0.1, 0.0), 0.1, 100.0), 1.0e-4);
  EXPECT_EQ(mode_error(kRk4, Complex(-1.0e4, 0.0), 1.0, 100.0), 1.0e6);
}

TEST(ModeError, IsMetByTheStepThatIsFoundForIt) {
  const Complex s(-0.01, 26.6);
  const double h = step_for_mode_error(kRk4, s, 0.1, 20.0, 0.01);
  EXPECT_LT(h, 0.02);
  EXPECT_NEAR(mode_error(kRk4, s, h, 20.0), 0.01, 2.0e-4);
}

/// Modes in every direction, growing ones too.
std::vector<Complex> modes(double rate) {
  std::vector<Complex> all;
  for (double angle = 0.0; angle <= 3.2; angle += 0.1) all.push_back(std::polar(rate, angle));
  return all;
}

TEST(ModeErrorBound, IsNoLessThanTheError) {
  for (const Tableau* tableau : {&kEuler, &kRk2, &kRk4})
    for (const double duration : {0.3, 10.0, 1000.0})
      for (const double rate : {1.0e-4, 0.01, 0.3, 2.0, 10.0, 29.0})
        for (const Complex s : modes(rate)) {
          const double error = mode_error(*tableau, s, 0.1, duration);
          const double bound = mode_error_bound(*tableau, s, 0.1, duration);
          EXPECT_GE(bound, error * (1.0 - 1.0e-9) - 1.0e-9) << s << " " << duration;
          const double farther = fastest_mode_error_bound(*tableau, 1.01 * rate, 0.1, duration);
          EXPECT_GE(farther, bound * (1.0 - 1.0e-9) - 1.0e-9) << s << " " << duration;
        }
}

TEST(ModeErrorBound, IsNearTheErrorWhileThatIsSmall) {
  for (const double rate : {0.5, 1.0, 2.0}) {
    const double error = mode_error(kRk4, Complex(0.0, rate), 0.1, 60.0);
    EXPECT_LT(mode_error_bound(kRk4, Complex(0.0, rate), 0.1, 60.0), 1.05 * error);
    EXPECT_LT(fastest_mode_error_bound(kRk4, rate, 0.1, 60.0), 1.3 * error);
  }
}

TEST(Advice, RoundsAStepDownToOneTwoOrFive) {
  EXPECT_EQ(nice_step(0.0049), 0.002);
  EXPECT_EQ(nice_step(0.005), 0.005);
  EXPECT_EQ(nice_step(0.9), 0.5);
  EXPECT_EQ(nice_step(1.0), 1.0);
  EXPECT_EQ(nice_step(3.1e-5), 2.0e-5);
}

TEST(Advice, WritesAStepAsPeopleDo) {
  EXPECT_EQ(step_words(5.0e-3), "5 ms");
  EXPECT_EQ(step_words(0.1), "0.1 s");
  EXPECT_EQ(step_words(20.0), "20 s");
  EXPECT_EQ(step_words(1.0e-5), "10 us");
}

TEST(Advice, PutsTheGravestFirstAndEndsItWithTheCure) {
  Resolution resolution;
  conclude({{ResolutionRule::kProbes, 2.0, "a", 0.1, "a little"},
            {ResolutionRule::kModalError, 9.0, "b", 0.45, "much"}},
           "--step '5 ms' resolves it", resolution);
  EXPECT_FALSE(resolution.resolved);
  EXPECT_EQ(resolution.rule, ResolutionRule::kModalError);
  EXPECT_EQ(resolution.worst_coordinate, "b");
  EXPECT_THAT(resolution.reasons,
              testing::ElementsAre("much. --step '5 ms' resolves it", "a little"));
}

class MotionRecords : public testing::Test {
 protected:
  Model model = test::model_of_every_kind();
  Observation sample(double time) { return test::sample_at(time, model); }
};

TEST_F(MotionRecords, KnowHowFarAJointWentInTheRunAndBetweenEvents) {
  MotionRecord record(model, {1.0});
  for (const auto& [time, angle] :
       {std::pair{0.0, 0.1}, {0.4, 0.3}, {0.8, 0.2}, {1.0, 1.0}, {1.5, -1.0}, {2.0, 0.0}}) {
    Observation seen = sample(time);
    seen.joint_position[0] = angle;
    record.see(seen, {});
  }
  EXPECT_DOUBLE_EQ(record.half_range(0), 1.0);
  EXPECT_DOUBLE_EQ(record.half_range(0, 0.0).value(), 0.1);
  EXPECT_DOUBLE_EQ(record.half_range(0, 1.0).value(), 1.0);
}

TEST_F(MotionRecords, BookTheVehiclesOwnEnergyApart) {
  MotionRecord record(model, {});
  const auto see = [&](double time, double kinetic, double springs, double work) {
    Observation seen = sample(time);
    seen.kinetic = 1.0e10;  // the orbit's
    seen.own_kinetic = kinetic;
    seen.springs = springs;
    Books books;
    books.own_work = work;
    record.see(seen, books);
  };
  see(0.0, 0.0, 2.0, 0.0);
  see(1.0, 1.0, 1.0, 0.0);
  see(2.0, 0.5, 0.5, -0.5);  // half a joule is missing, half was taken by a damper
  EXPECT_DOUBLE_EQ(record.energy().drift(), 0.5);
  EXPECT_DOUBLE_EQ(record.energy().exchanged(), 1.5);
  EXPECT_TRUE(record.energy().is_exchanging());
  EXPECT_DOUBLE_EQ(record.energy().relative(), 0.5 / 1.5);
}

TEST_F(MotionRecords, KeepTheSampleBeforeARateJumps) {
  MotionRecord record(model, {});
  for (int i = 0; i <= 20; ++i) {
    Observation seen = sample(0.1 * i);
    seen.joint_rate[2] = i > 12 ? 5.0 : 0.01 * i;
    record.see(seen, {});
  }
  const std::vector<Observation> jumps = record.jumps();
  EXPECT_TRUE(std::ranges::any_of(
      jumps, [](const Observation& seen) { return std::abs(seen.time - 1.2) < 1.0e-9; }));
  EXPECT_LE(jumps.size(), 8U);
}

}  // namespace
}  // namespace twincraft
