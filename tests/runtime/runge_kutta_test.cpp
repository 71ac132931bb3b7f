// The stepper on problems with known answers, against Boost's Fehlberg 7(8), and the step control
// that drives it.
#include "runtime/integrate/runge_kutta.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "runtime/engine/engine.h"
#include "runtime/integrate/step_control.h"

namespace twincraft {
namespace {

using testing::HasSubstr;

/// An ODE from a function; `times` are those of its evaluations.
class FunctionOde : public Ode {
 public:
  using Rate = std::function<void(double, std::span<const double>, std::span<double>)>;
  FunctionOde(int size, Rate rate) : size_(size), rate_(std::move(rate)) {}
  int size() const override { return size_; }
  int read_size() const override { return read > 0 ? read : size_; }
  void derivative(double time, std::span<const double> state, std::span<double> rate) override {
    times.push_back(time);
    rate_(time, state, rate);
  }
  void finish_step(std::span<double>) override {}
  StageAccess access() const override { return how; }
  std::vector<double> times;
  StageAccess how;
  int read = 0;  // 0: all

 private:
  int size_;
  Rate rate_;
};

/// Coupled, nonlinear and dependent on time.
void nonlinear(double t, std::span<const double> y, std::span<double> rate) {
  rate[0] = y[0] * std::cos(t);
  rate[1] = -y[1] * y[1] * std::cos(t) + 0.1 * y[0];
}

/// Two bodies with mu = 1 and a = 1: half a revolution takes pi and ends at apoapsis.
void two_body(double, std::span<const double> y, std::span<double> rate) {
  const double r = std::hypot(y[0], y[1]);
  rate[0] = y[2];
  rate[1] = y[3];
  rate[2] = -y[0] / (r * r * r);
  rate[3] = -y[1] / (r * r * r);
}

/// Error after half a revolution from periapsis in `steps` equal steps.
double error_after(const Tableau& tableau, int steps) {
  constexpr double e = 0.3;
  const double fastest = std::sqrt((1.0 + e) / (1.0 - e));
  FunctionOde ode(4, two_body);
  RungeKutta stepper(tableau, ode);
  Eigen::Map<Eigen::Vector4d> state(stepper.state().data());
  state << 1.0 - e, 0.0, 0.0, fastest;
  const double h = std::numbers::pi / steps;
  for (int i = 0; i < steps; ++i) stepper.step(i * h, h);
  return (state - Eigen::Vector4d(-1.0 - e, 0.0, 0.0, -1.0 / fastest)).norm();
}

class EveryMethod : public testing::TestWithParam<Method> {
 protected:
  Tableau tableau_ = tableau_of(GetParam());
};

std::string name_of(const testing::TestParamInfo<Method>& tested) {
  return std::string(tableau_of(tested.param).name);
}

INSTANTIATE_TEST_SUITE_P(RungeKutta, EveryMethod,
                         testing::Values(Method::kEuler, Method::kRk2, Method::kRk4, Method::kRkf45,
                                         Method::kRkf78),
                         name_of);

class EveryPair : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(RungeKutta, EveryPair, testing::Values(Method::kRkf45, Method::kRkf78),
                         name_of);

/// Observed order between `steps` and twice as many.
double observed_order(const Tableau& tableau, int steps) {
  return std::log2(error_after(tableau, steps) / error_after(tableau, 2 * steps));
}

TEST_P(EveryMethod, ShowsItsOrderOnANonlinearProblem) {
  // Enough steps for the leading term to rule, few enough to stay above rounding.
  const int steps = tableau_.order == 1 ? 1024 : tableau_.order == 7 ? 64 : 128;
  EXPECT_NEAR(observed_order(tableau_, steps), tableau_.order, 0.2);
}

TEST_P(EveryPair, ShowsOneOrderMoreInItsComparisonSolution) {
  tableau_.b = tableau_.b_hat;
  const int steps = tableau_.order == 7 ? 32 : 256;
  EXPECT_NEAR(observed_order(tableau_, steps), tableau_.order + 1, 0.2);
}

TEST_P(EveryMethod, IsExactOnPolynomialsOfItsOrder) {
  const int order = tableau_.order;
  FunctionOde ode(1, [order](double t, auto, std::span<double> rate) {
    rate[0] = order * std::pow(t, order - 1);
  });
  RungeKutta stepper(tableau_, ode);
  stepper.step(0.0, 0.7);
  stepper.step(0.7, 0.9);
  EXPECT_NEAR(stepper.state()[0], std::pow(1.6, order), 1.0e-14 * std::pow(1.6, order));
}

/// States and error estimates after steps and attempts of an equation with 13 entries.
std::vector<double> flown(const Tableau& tableau, StageAccess how) {
  FunctionOde ode(13, [](double t, std::span<const double> y, std::span<double> rate) {
    for (std::size_t i = 0; i < 13; ++i)
      rate[i] = std::sin(t + static_cast<double>(i)) * y[(i + 5) % 13] - 0.3 * y[i];
  });
  ode.how = how;
  RungeKutta stepper(tableau, ode);
  for (std::size_t i = 0; i < 13; ++i) stepper.state()[i] = 1.0 / static_cast<double>(i + 1);
  for (int i = 0; i < 20; ++i) {
    if (tableau.adaptive && i % 2 == 1) {
      stepper.attempt(0.1 * i, 0.1);
      stepper.accept();
    } else {
      stepper.step(0.1 * i, 0.1);
    }
  }
  std::vector<double> seen(stepper.state().begin(), stepper.state().end());
  seen.insert(seen.end(), stepper.solution().carry.begin(), stepper.solution().carry.end());
  if (tableau.adaptive) seen.insert(seen.end(), stepper.error().begin(), stepper.error().end());
  return seen;
}

TEST_P(EveryMethod, GivesTheSameBytesInRegistersOfAnyWidth) {
  const std::vector<double> alone = flown(tableau_, {false, 1});
  EXPECT_EQ(flown(tableau_, {false, 2}), alone);
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "this processor has no AVX2";
  for (const std::size_t written : {1, 2, 4, 8}) EXPECT_EQ(flown(tableau_, {true, written}), alone);
}

TEST_P(EveryMethod, LeavesAStateBitwiseAloneWhenQuadraturesAreAppended) {
  FunctionOde bare(2, nonlinear);
  FunctionOde wide(9, [](double t, std::span<const double> y, std::span<double> rate) {
    nonlinear(t, y.first(2), rate.first(2));
    for (std::size_t i = 2; i < 9; ++i) rate[i] = y[0] * static_cast<double>(i);
  });
  FunctionOde said = wide;
  said.read = 2;
  RungeKutta alone(tableau_, bare);
  RungeKutta accompanied(tableau_, wide);
  RungeKutta in_part(tableau_, said);
  for (RungeKutta* stepper : {&alone, &accompanied, &in_part}) {
    stepper->state()[0] = stepper->state()[1] = 1.0;
    for (int i = 0; i < 30; ++i) stepper->step(0.1 * i, 0.1);
  }
  EXPECT_EQ(alone.state()[0], accompanied.state()[0]);
  EXPECT_EQ(alone.state()[1], accompanied.state()[1]);
  EXPECT_NE(accompanied.state()[8], 0.0);
  EXPECT_TRUE(std::ranges::equal(in_part.state(), accompanied.state()));
}

TEST(RungeKutta, DoesNotLetRoundingGrowWithTheNumberOfSteps) {
  // A million times 0.1 added one by one is off by 1.3e-6.
  FunctionOde ode(1, [](double, auto, std::span<double> rate) { rate[0] = 1.0; });
  RungeKutta stepper(kEuler, ode);
  for (int i = 0; i < 1'000'000; ++i) stepper.step(0.0, 0.1);
  EXPECT_NEAR(stepper.state()[0], 1.0e5, 2.0e-11);
}

TEST(RungeKutta, EvaluatesFehlberg78AsBoostDoes) {
  // Boost propagates the eighth-order solution and reports eighth minus seventh.
  using State = std::array<double, 2>;
  State boost_state{1.0, 1.0};
  State boost_error{};
  boost::numeric::odeint::runge_kutta_fehlberg78<State> boost_stepper;
  boost_stepper.do_step([](const State& y, State& rate, double t) { nonlinear(t, y, rate); },
                        boost_state, 0.3, 0.8, boost_error);
  FunctionOde ode(2, nonlinear);
  RungeKutta stepper(kRkf78, ode);
  std::fill(stepper.state().begin(), stepper.state().end(), 1.0);
  stepper.attempt(0.3, 0.8);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(stepper.proposal()[i], boost_state[i] - boost_error[i], 1.0e-15);
    EXPECT_NEAR(stepper.error()[i], -boost_error[i], 1.0e-15);
    EXPECT_GT(std::abs(stepper.error()[i]), 1.0e-10) << "too smooth a problem to tell";
  }
}

TEST(RungeKutta, NoticesAnyNonFiniteEntryAndNamesTheOneThatFailedFirst) {
  // Entry 3 fails in the second stage; entry 1 hears of it a stage later.
  FunctionOde ode(5, [](double t, std::span<const double> y, std::span<double> rate) {
    std::fill(rate.begin(), rate.end(), 0.0);
    if (t > 0.0) rate[3] = std::numeric_limits<double>::quiet_NaN();
    rate[1] = y[3];
  });
  RungeKutta stepper(kRk4, ode);
  EXPECT_TRUE(stepper.state_is_finite());
  stepper.step(0.0, 0.1);
  EXPECT_FALSE(stepper.state_is_finite());
  EXPECT_EQ(stepper.first_non_finite(), 3);
}

TEST(RungeKutta, NoticesOverflowOfTheStateAlone) {
  constexpr double kHuge = std::numeric_limits<double>::max();
  FunctionOde ode(5, [](double, auto, std::span<double> rate) {
    std::fill(rate.begin(), rate.end(), 0.0);
    rate[4] = kHuge;
  });
  RungeKutta stepper(kEuler, ode);
  stepper.state()[4] = kHuge;
  stepper.step(0.0, 0.5);
  EXPECT_FALSE(stepper.state_is_finite());
  EXPECT_EQ(stepper.first_non_finite(), 4);
}

constexpr Tolerance kLoose{1.0e-6, 0.0};
constexpr BlockTolerances kAllLoose{kLoose, kLoose, kLoose, kLoose, kLoose, kLoose, kLoose};

std::vector<std::string> numbered(int size) {
  std::vector<std::string> names;
  for (int i = 0; i < size; ++i) names.push_back("entry " + std::to_string(i));
  return names;
}

StepControl control_of(const StateLayout& layout, const BlockTolerances& tolerance = kAllLoose) {
  return {layout, tolerance, numbered(layout.size())};
}

TEST(StepControl, NamesTheBlockWithTheLargestErrorOverItsOwnTolerance) {
  const StateLayout layout{AttitudeChart::kMrp, 2, 1};
  std::vector<double> state(static_cast<std::size_t>(layout.size()), 0.0);
  std::vector<double> error = state;
  BlockTolerances tolerance = kAllLoose;
  tolerance.wheel = {1.0e-9, 0.0};
  error[0] = 5.0e-6;                                         // position: ratio 5
  error[static_cast<std::size_t>(layout.wheel())] = 2.0e-8;  // wheel: ratio 20
  const StepControl::Verdict verdict = control_of(layout, tolerance).judge(state, error);
  EXPECT_EQ(verdict.block, Block::kWheel);
  EXPECT_DOUBLE_EQ(verdict.ratio, 20.0);
  EXPECT_FALSE(verdict.passes());
  EXPECT_EQ(block_name(verdict.block), "wheel");
}

TEST(StepControl, MeasuresRelativeToleranceByTheNormOfTheBlock) {
  const StateLayout layout{AttitudeChart::kMrp, 0, 0};
  std::vector<double> state(12, 0.0);
  std::vector<double> error(12, 0.0);
  state[0] = 3.0;
  state[2] = 4.0;
  error[1] = 0.06;
  BlockTolerances tolerance = kAllLoose;
  tolerance.position = {0.01, 0.01};
  EXPECT_DOUBLE_EQ(control_of(layout, tolerance).judge(state, error).ratio, 1.0);
}

TEST(StepControl, MeansTheSameAngleByAnMrpAndByAQuaternion) {
  const StateLayout mrp{AttitudeChart::kMrp, 0, 0};
  const StateLayout quaternion{AttitudeChart::kQuaternion, 0, 0};
  BlockTolerances tolerance = kAllLoose;
  tolerance.attitude = {1.0e-7, 1.0e-7};
  const Quaterniond q(Eigen::AngleAxisd(2.5, Vector3d(1.0, -2.0, 0.5).normalized()));
  const Quaterniond turned = q * Quaterniond(Eigen::AngleAxisd(1.0e-5, Vector3d::UnitY()));
  const auto sigma = [](const Quaterniond& p) -> Vector3d { return p.vec() / (1.0 + p.w()); };

  std::vector<double> state(12, 0.0);
  std::vector<double> error(12, 0.0);
  Vector3d::Map(&state[6]) = sigma(q);
  Vector3d::Map(&error[6]) = sigma(turned) - sigma(q);
  const auto by_mrp = control_of(mrp, tolerance).judge(state, error);

  state.resize(13);
  error.resize(13);
  Eigen::Vector4d::Map(&state[6]) << q.w(), q.vec();
  Eigen::Vector4d::Map(&error[6]) << turned.w() - q.w(), turned.vec() - q.vec();
  Eigen::Vector4d::Map(&error[6]) += 1.0e-3 * Eigen::Vector4d::Map(&state[6]);  // no rotation
  const auto by_quaternion = control_of(quaternion, tolerance).judge(state, error);

  const double expected = 1.0e-5 / (1.0e-7 + 1.0e-7 * 2.5);
  EXPECT_NEAR(by_mrp.ratio, expected, 1.0e-4 * expected);
  EXPECT_NEAR(by_quaternion.ratio, expected, 1.0e-4 * expected);
}

TEST(StepControl, AcceptsAnErrorOfZeroAtAToleranceOfZero) {
  const StateLayout layout{AttitudeChart::kMrp, 0, 0};
  const std::vector<double> zeros(12, 0.0);
  EXPECT_TRUE(control_of(layout, BlockTolerances{}).judge(zeros, zeros).passes());
}

TEST(StepControl, NeverPassesNan) {
  const StateLayout layout{AttitudeChart::kMrp, 0, 0};
  const std::vector<double> state(12, 0.0);
  std::vector<double> error(12, 0.0);
  error[10] = std::numeric_limits<double>::quiet_NaN();
  const auto verdict = control_of(layout).judge(state, error);
  EXPECT_FALSE(verdict.passes());
  EXPECT_EQ(verdict.block, Block::kRate);
}

/// Twelve entries of which only the first changes.
FunctionOde position_ode(std::function<double(double)> rate_of_position) {
  return {12, [rate_of_position](double t, auto, std::span<double> rate) {
            std::fill(rate.begin(), rate.end(), 0.0);
            rate[0] = rate_of_position(t);
          }};
}

TEST(StepControl, StartsWithTheWholeIntervalAndShrinksAtMostTenfold) {
  FunctionOde ode = position_ode([](double t) { return 1.0e9 * std::exp(t); });
  RungeKutta stepper(kRkf45, ode);
  StepCounts counts;
  control_of({AttitudeChart::kMrp, 0, 0}).advance(stepper, 0.0, 2.0, counts);
  ASSERT_GE(ode.times.size(), 12u);
  EXPECT_EQ(*std::max_element(ode.times.begin(), ode.times.begin() + 6), 2.0);
  EXPECT_DOUBLE_EQ(*std::max_element(ode.times.begin() + 6, ode.times.begin() + 12), 0.2);
  EXPECT_GE(counts.rejected, 1);
}

TEST(StepControl, ScalesTheNextStepByTheErrorRatio) {
  // y' = t^4: the first step from zero has an error of C h^5 and is 32 times over the tolerance.
  FunctionOde ode = position_ode([](double t) { return std::pow(t, 4); });
  RungeKutta stepper(kRkf45, ode);
  stepper.attempt(0.0, 1.0);
  const double error = std::abs(stepper.error()[0]);
  BlockTolerances tolerance = kAllLoose;
  tolerance.position.absolute = error / 32.0;
  ode.times.clear();
  StepCounts counts;
  control_of({AttitudeChart::kMrp, 0, 0}, tolerance).advance(stepper, 0.0, 1.0, counts);
  // 32^(-1/5) = 1/2
  EXPECT_NEAR(*std::max_element(ode.times.begin() + 6, ode.times.begin() + 12), 0.45, 1.0e-12);
}

TEST(StepControl, CountsAttemptsEvaluationsAndTheDrivingBlock) {
  FunctionOde ode = position_ode([](double t) { return std::exp(t); });
  RungeKutta stepper(kRkf45, ode);
  StepCounts counts;
  const StepControl control = control_of({AttitudeChart::kMrp, 0, 0});
  EXPECT_EQ(control.advance(stepper, 0.0, 3.0, counts), 3.0);
  EXPECT_GT(counts.rejected, 0);
  EXPECT_EQ(counts.evaluations, 6 * (counts.accepted + counts.rejected));
  EXPECT_EQ(counts.evaluations, static_cast<long>(ode.times.size()));
  EXPECT_EQ(counts.driven_by[0], counts.accepted + counts.rejected);
}

TEST(StepControl, FailsOnNanNamingTheEntryAndTheTime) {
  FunctionOde ode = position_ode([](double t) { return std::sqrt(1.0 - t); });
  RungeKutta stepper(kRkf45, ode);
  StepCounts counts;
  const StepControl control = control_of({AttitudeChart::kMrp, 0, 0});
  try {
    control.advance(stepper, 0.0, 3.0, counts);
    FAIL() << "stepped over the edge of the square root";
  } catch (const NumericalFailure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("`entry 0` is not finite at t = 0.99999"));
  }
}

TEST(StepControl, FailsOnStepUnderflowNamingTheBlockAndTheTime) {
  // Noise is never smooth, however short the step.
  double sign = 1.0;
  FunctionOde ode = position_ode([&sign](double) { return sign = -sign; });
  RungeKutta stepper(kRkf45, ode);
  BlockTolerances tolerance = kAllLoose;
  tolerance.position.absolute = 1.0e-30;
  StepCounts counts;
  const StepControl control = control_of({AttitudeChart::kMrp, 0, 0}, tolerance);
  try {
    control.advance(stepper, 1.0, 2.0, counts);
    FAIL() << "accepted noise";
  } catch (const NumericalFailure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("underflow at t = 1 s"));
    EXPECT_THAT(failure.what(), HasSubstr("`position`"));
  }
}

}  // namespace
}  // namespace twincraft
