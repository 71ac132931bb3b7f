// What a campaign asks of a run, by signals whose answers are known: lines, parabolas, and random
// walks against the definition read word by word.
#include "runtime/campaign/reductions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "tests/runtime/handmade.h"

namespace twincraft {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::Optional;

struct Point {
  double time, value;
};

std::optional<double> reduce(const OutputPlan& plan, const std::vector<Point>& signal) {
  const std::unique_ptr<Reduction> reduction = Reduction::make(plan);
  for (const Point& point : signal) reduction->take(point.time, point.value);
  return reduction->result();
}
OutputPlan plan_of(const std::string& signal, Reduce reduce) {
  OutputPlan plan;
  plan.signal = signal;
  plan.reduce = reduce;
  return plan;
}

std::optional<double> reduce(Reduce kind, const std::vector<Point>& signal) {
  return reduce(plan_of("x", kind), signal);
}
std::optional<double> settle(double within, const std::vector<Point>& signal) {
  OutputPlan plan = plan_of("x", Reduce::kSettlingTime);
  plan.within = within;
  return reduce(plan, signal);
}
std::optional<double> cross(double level, const std::vector<Point>& signal) {
  OutputPlan plan = plan_of("x", Reduce::kFirstCrossing);
  plan.level = level;
  return reduce(plan, signal);
}

const std::vector<Point> kSwing = {{0, 1}, {1, -3}, {3, 2}, {4, 0}};

TEST(Reductions, TakeExtremesOfTheSamples) {
  EXPECT_EQ(reduce(Reduce::kMax, kSwing), 2.0);
  EXPECT_EQ(reduce(Reduce::kMin, kSwing), -3.0);
  EXPECT_EQ(reduce(Reduce::kMaxAbs, kSwing), 3.0);
  EXPECT_EQ(reduce(Reduce::kFinal, kSwing), 0.0);
  EXPECT_EQ(reduce(Reduce::kMax, {{0, -2}, {1, -1}}), -1.0);
  EXPECT_EQ(reduce(Reduce::kMin, {{0, 2}, {1, 5}}), 2.0);
}

TEST(Reductions, WeighMeansByTime) {
  // (1 - 3)/2 + 2 (-3 + 2)/2 + (2 + 0)/2, over four seconds; squares alike.
  EXPECT_EQ(reduce(Reduce::kMean, kSwing), -0.25);
  EXPECT_EQ(reduce(Reduce::kRms, kSwing), std::sqrt((5.0 + 13.0 + 2.0) / 4.0));
}

TEST(Reductions, AreNotMovedByAStateThatComesTwice) {
  std::vector<Point> twice = kSwing;
  twice.push_back(twice.back());
  for (const Reduce kind :
       {Reduce::kMax, Reduce::kMin, Reduce::kMaxAbs, Reduce::kFinal, Reduce::kMean, Reduce::kRms})
    EXPECT_EQ(reduce(kind, twice), reduce(kind, kSwing));
  EXPECT_EQ(settle(0.5, twice), settle(0.5, kSwing));
  EXPECT_EQ(cross(-1.0, twice), cross(-1.0, kSwing));
}

TEST(Reductions, OfOneSampleAreThatSample) {
  for (const Reduce kind : {Reduce::kMax, Reduce::kMin, Reduce::kFinal, Reduce::kMean})
    EXPECT_EQ(reduce(kind, {{2, -3}}), -3.0);
  EXPECT_EQ(reduce(Reduce::kRms, {{2, -3}}), 3.0);
  EXPECT_EQ(settle(0.1, {{2, -3}}), 2.0);
}

TEST(Reductions, OfNoSampleAreNothing) {
  for (const Reduce kind :
       {Reduce::kMax, Reduce::kMin, Reduce::kMaxAbs, Reduce::kMaxNorm, Reduce::kFinal,
        Reduce::kMean, Reduce::kRms, Reduce::kSettlingTime, Reduce::kFirstCrossing})
    EXPECT_EQ(reduce(kind, {}), std::nullopt);
}

TEST(FirstCrossing, LiesBetweenSamples) {
  EXPECT_EQ(cross(-1.0, kSwing), 0.5);
  EXPECT_EQ(cross(1.5, kSwing), 2.8);   // from below
  EXPECT_EQ(cross(1.0, kSwing), 0.0);   // where it starts
  EXPECT_EQ(cross(-3.0, kSwing), 1.0);  // touched alone
  EXPECT_EQ(cross(2.5, kSwing), std::nullopt);
}

TEST(SettlingTime, IsTheLastEntryIntoTheBandOfTheLastValue) {
  EXPECT_EQ(settle(0.5, kSwing), 3.75);  // from 2 down to 0.5
  EXPECT_EQ(settle(2.5, kSwing), 1.2);   // from -3 up to -2.5
  EXPECT_EQ(settle(3.0, kSwing), 0.0);   // never outside: the ends count
  EXPECT_EQ(settle(0.0, kSwing), 4.0);
  EXPECT_EQ(settle(0.5, {{0, 4}, {1, 2}, {2, 0}}), 1.75);    // falls all the time
  EXPECT_EQ(settle(0.5, {{0, -4}, {1, -2}, {2, 0}}), 1.75);  // rises all the time
}

/// The definition, with all samples at hand.
double settled_by_definition(double within, const std::vector<Point>& signal) {
  const double last = signal.back().value;
  for (std::size_t i = signal.size() - 1; i-- > 0;) {
    const Point& from = signal[i];
    const Point& to = signal[i + 1];
    if (std::abs(from.value - last) <= within) continue;
    const double end = from.value > last ? last + within : last - within;
    return from.time + (end - from.value) / (to.value - from.value) * (to.time - from.time);
  }
  return signal.front().time;
}

TEST(SettlingTime, OfRandomWalksIsThatOfTheDefinition) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int walk = 0; walk < 300; ++walk) {
    std::vector<Point> signal;
    double value = 0.0;
    for (int i = 0; i < 100; ++i) signal.push_back({0.1 * i, value += normal(random)});
    // Whole numbers, so that values repeat.
    if (walk % 2 == 0)
      for (Point& point : signal) point.value = std::round(point.value);
    for (const double within : {0.5, 1.0, 3.0, 10.0})
      ASSERT_THAT(settle(within, signal),
                  Optional(DoubleNear(settled_by_definition(within, signal), 1e-12)))
          << walk << ' ' << within;
  }
}

class Reducer : public testing::Test {
 protected:
  Model model_ = test::model_of_every_kind();
};

TEST_F(Reducer, FindsNumbersAndVectorsByName) {
  const std::vector<OutputPlan> plans = {
      plan_of("wing.1.position", Reduce::kMaxAbs), plan_of("omega_BN_B.y", Reduce::kMin),
      plan_of("omega_BN_B", Reduce::kMaxNorm),     plan_of("q_BN.w", Reduce::kFinal),
      plan_of("rw_y.rate", Reduce::kMean),         plan_of("mass", Reduce::kFinal)};
  OutputReducer reducer(model_, plans);
  Observation sample = test::sample_at(0.0, model_);
  reducer.take(sample);
  sample.time = 2.0;
  sample.joint_position[0] = -0.5;
  sample.omega_BN_B = Vector3d(1.0, -2.0, 2.0);
  sample.wheel_rate[1] = 10.0;
  reducer.take(sample);
  EXPECT_THAT(reducer.results(), ElementsAre(0.5, -2.0, 3.0, 1.0, 5.0, 100.0));
}

TEST_F(Reducer, GivesNothingForWhatIsNoNumber) {
  const std::vector<OutputPlan> plans = {plan_of("rw_x.rate", Reduce::kFinal),
                                         plan_of("rw_y.rate", Reduce::kFinal)};
  OutputReducer reducer(model_, plans);
  Observation sample = test::sample_at(0.0, model_);
  sample.wheel_rate[0] = std::nan("");
  reducer.take(sample);
  EXPECT_THAT(reducer.results(), ElementsAre(std::nullopt, 0.0));
}

TEST_F(Reducer, RefusesASignalThatTheModelDoesNotHave) {
  for (const char* signal : {"wing.3.position", "omega_BN_B.w", "rw_x.position", "", "q_BN."}) {
    const std::vector<OutputPlan> plans = {plan_of(signal, Reduce::kMax)};
    EXPECT_THROW(OutputReducer(model_, plans), std::invalid_argument) << signal;
  }
}

}  // namespace
}  // namespace twincraft
