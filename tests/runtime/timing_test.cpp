// Claims about the timing protocol: which runs, in which order, and what is made of them.
#include "runtime/simulate/timing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace twincraft {
namespace {

using testing::ElementsAre;

class Protocol : public testing::Test {
 protected:
  TimedEngine contestant(const std::string& name) {
    return {name, [this, name] {
              log.push_back(name);
              return std::size_t{100};
            }};
  }
  std::vector<std::string> log;
  std::vector<TimedEngine> both{contestant("bsm"), contestant("mujoco")};
  MayGoOn always = [](int, int) { return true; };
};

TEST_F(Protocol, WarmsUpOnceThenReversesTheOrderOnAlternateRounds) {
  time_engines(both, 3, always);
  EXPECT_THAT(log, ElementsAre("bsm", "mujoco",  // warm-up
                               "bsm", "mujoco",  //
                               "mujoco", "bsm",  //
                               "bsm", "mujoco"));
}

TEST_F(Protocol, DiscardsTheWarmUp) {
  const Timing timing = time_engines(both, 5, always);
  ASSERT_EQ(timing.engines.size(), 2u);
  EXPECT_EQ(timing.engines[0].trials.size(), 5u);
  EXPECT_EQ(timing.engines[1].trials.size(), 5u);
  EXPECT_EQ(timing.engines[1].steps, 100u);
  EXPECT_TRUE(timing.complete());
  EXPECT_EQ(protocol(timing), "warmup=1 trials=5 interleaved reversed");
}

TEST_F(Protocol, AsksBeforeEveryRunAndStopsWhenTold) {
  const Timing timing = time_engines(both, 3, [](int done, int planned) {
    EXPECT_EQ(planned, 8);
    return done < 4;
  });
  EXPECT_EQ(log.size(), 4u);
  EXPECT_FALSE(timing.complete());
  EXPECT_FALSE(timing.ratio().has_value());
}

TEST_F(Protocol, MeasuresTheRunAndNothingElse) {
  double now = 1.0e3;                             // [s] of a clock that only the test moves
  std::vector<double> runs{64.0, 2.0, 8.0, 4.0};  // [s] the warm-up and three trials
  std::size_t done = 0;
  const std::vector<TimedEngine> engine{{"bsm", [&] {
                                           now += runs[done++];
                                           return std::size_t{10};
                                         }}};
  const auto slow_to_answer = [&now](int, int) {
    now += 500.0;
    return true;
  };
  const Timing timing = time_engines(engine, 3, slow_to_answer, [&now] { return now; });
  EXPECT_THAT(timing.engines[0].trials, ElementsAre(2.0, 8.0, 4.0));
  EXPECT_EQ(timing.engines[0].median(), 4.0);
  EXPECT_EQ(timing.engines[0].per_step(), 0.4);
}

TEST(Clock, NeverGoesBack) {
  double last = monotonic_seconds();
  for (int i = 0; i < 1000; ++i) {
    const double now = monotonic_seconds();
    ASSERT_GE(now, last);
    last = now;
  }
}

TEST_F(Protocol, CountsNoTrialThatWasStopped) {
  int runs = 0;
  const std::vector<TimedEngine> impatient{
      {"bsm", [&runs] { return ++runs < 3 ? std::size_t{10} : std::size_t{0}; }}};
  const Timing timing = time_engines(impatient, 5, always);
  EXPECT_EQ(timing.engines[0].trials.size(), 1u);  // after the warm-up
  EXPECT_EQ(timing.engines[0].steps, 10u);
  EXPECT_FALSE(timing.complete());
}

TEST_F(Protocol, LetsAFailureThrough) {
  const std::vector<TimedEngine> broken{
      {"bsm", []() -> std::size_t { throw NumericalFailure("not finite"); }}};
  EXPECT_THROW(time_engines(broken, 1, always), NumericalFailure);
}

TEST(Ratio, IsTheFirstEngineOverTheSecond) {
  const Timing timing{3, {{"bsm", {1.0, 2.0, 9.0}, 1}, {"mujoco", {8.0, 10.0, 4.0}, 1}}};
  EXPECT_EQ(timing.ratio(), 0.25);
}

TEST(Ratio, IsRefusedWhenTrialsScatter) {
  Timing timing{5,
                {{"bsm", {1.0, 1.1, 1.0, 5.0, 9.0}, 1}, {"mujoco", {4.0, 4.0, 4.0, 4.0, 4.0}, 1}}};
  EXPECT_NEAR(timing.engines[0].spread(), 0.1 / 1.1, 1.0e-15);  // two outliers change little
  EXPECT_TRUE(timing.ratio().has_value());
  timing.engines[0].trials = {1.0, 2.0, 4.0, 8.0, 16.0};
  EXPECT_DOUBLE_EQ(timing.engines[0].spread(), 0.75);
  EXPECT_FALSE(timing.ratio().has_value());
}

TEST(Ratio, OfOneEngineDoesNotExist) {
  const Timing timing{1, {{"bsm", {1.0}, 1}}};
  EXPECT_FALSE(timing.ratio().has_value());
}

TEST(Median, IsTheMiddleOrTheMeanOfTheMiddleTwo) {
  EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({4.0, 1.0, 2.0, 100.0}), 3.0);
  EXPECT_EQ(median({7.0}), 7.0);
}

}  // namespace
}  // namespace twincraft
