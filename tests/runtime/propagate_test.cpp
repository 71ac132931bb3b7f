// Whole runs of a toy engine: where steps land, what is recorded, what events do to the order, and
// how a run ends when it does not go well.
#include "runtime/simulate/propagate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "runtime/integrate/landings.h"
#include "tests/runtime/toy_engine.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> times_of(Landings landings) {
  std::vector<double> times;
  while (!landings.done()) times.push_back(landings.next().time);
  return times;
}

std::vector<double> sample_times(const Trajectory& trajectory) {
  std::vector<double> times;
  for (const Observation& sample : trajectory.samples) times.push_back(sample.time);
  return times;
}

TEST(Landings, AreMultiplesOfTheStepWithoutDrift) {
  Landings landings(0.1, 1.0e5, {});
  std::int64_t index = 0;
  double time = 0.0;
  while (!landings.done()) {
    time = landings.next().time;
    ASSERT_EQ(time, static_cast<double>(++index) * 0.1);
  }
  EXPECT_EQ(time, 1.0e5);
  EXPECT_EQ(index, 1'000'000);
}

TEST(Landings, ShortenTheLastStepWhenTheStepDoesNotDivideTheDuration) {
  EXPECT_THAT(times_of({0.25, 0.6, {}}), ElementsAre(0.25, 0.5, 0.6));
  EXPECT_THAT(times_of({1.0, 0.6, {}}), ElementsAre(0.6));
}

TEST(Landings, EndAtTheDurationItselfWhenAMultipleMissesItByRounding) {
  EXPECT_THAT(times_of({0.1, 0.3, {}}), ElementsAre(0.1, 0.2, 0.3));  // 3 * 0.1 > 0.3
  EXPECT_THAT(times_of({1.0 / 3, 1.0, {}}), ElementsAre(1.0 / 3, 2.0 / 3, 1.0));
}

TEST(Landings, SplitStepsAtEventsAndMergeThoseThatCoincide) {
  Landings landings(0.1, 0.4, {0.25, 0.3});
  EXPECT_THAT(times_of(landings), ElementsAre(0.1, 0.2, 0.25, 0.3, 0.4));
  std::vector<bool> events;
  while (!landings.done()) events.push_back(landings.next().is_event);
  EXPECT_THAT(events, ElementsAre(false, false, true, true, false));
}

TEST(Landings, IgnoreAnEventThatCoincidesWithTheEnd) {
  EXPECT_THAT(times_of({0.1, 0.2, {0.2 - 1.0e-13}}), ElementsAre(0.1, 0.2));
}

TEST(Landings, AreNoneWithoutDuration) { EXPECT_TRUE(Landings(0.1, 0.0, {}).done()); }

TEST(Propagate, RecordsMultiplesOfTheIntervalAndBothEnds) {
  Model model = toy_model();
  model.simulation.duration = 1.05;
  model.simulation.record = 0.5;
  ToyEngine engine(model);
  const Trajectory trajectory = propagate(engine, model);
  EXPECT_EQ(trajectory.status, Trajectory::Status::kComplete);
  EXPECT_EQ(trajectory.t_end, 1.05);
  EXPECT_THAT(sample_times(trajectory), ElementsAre(0.0, 0.5, 1.0, 1.05));
  EXPECT_EQ(trajectory.books.size(), trajectory.samples.size());
}

TEST(Propagate, RecordsTheFirstStepEndAfterARecordTimeThatIsNoMultiple) {
  Model model = toy_model();
  model.simulation.step = 0.25;
  model.simulation.record = 0.4;
  ToyEngine engine(model);
  const Trajectory trajectory = propagate(engine, model);
  EXPECT_THAT(sample_times(trajectory), ElementsAre(0.0, 0.5, 1.0));
  EXPECT_EQ(trajectory.counts.accepted, 4) << "a step was split for a record";
}

TEST(RecordedRun, IsTheSameInPiecesOfAnyLength) {
  Model model = toy_model();
  push_about_z(model, {{{0.0, 2.0}, {0.33, 3.0}}});
  model.simulation.record = 0.2;
  for (const Method method : {Method::kRk4, Method::kRkf78}) {
    model.simulation.method = method;
    ToyEngine whole_engine(model), engine(model);
    const Trajectory whole = propagate(whole_engine, model);
    SampleStore store;
    RecordedRun run(engine, model, store);
    for (double until = 0.0; !run.ended(); until += 0.13) run.advance_until(until);
    const Trajectory pieces = run.take_trajectory();
    ASSERT_EQ(store.samples.size(), whole.samples.size());
    for (std::size_t i = 0; i < whole.samples.size(); ++i) {
      EXPECT_EQ(store.samples[i].time, whole.samples[i].time);
      EXPECT_EQ(store.samples[i].q_BN.coeffs(), whole.samples[i].q_BN.coeffs());
      EXPECT_EQ(store.books[i].angular_impulse_N, whole.books[i].angular_impulse_N);
    }
    EXPECT_EQ(pieces.recorded, whole.samples.size());
    EXPECT_EQ(pieces.counts.accepted, whole.counts.accepted);
    EXPECT_EQ(engine.final_state, whole_engine.final_state);
  }
}

TEST(RecordedRun, GoesToTheFirstLandingAtOrAfterAnInstant) {
  const Model model = toy_model();
  ToyEngine engine(model);
  SampleStore store;
  RecordedRun run(engine, model, store);
  EXPECT_EQ(run.time(), 0.0);
  run.advance_until(0.25);
  EXPECT_EQ(run.time(), 3 * 0.1);
  run.advance_until(0.2);
  EXPECT_EQ(run.time(), 3 * 0.1);
  EXPECT_FALSE(run.ended());
  run.advance_until(5.0);
  EXPECT_EQ(run.time(), 1.0);
  EXPECT_TRUE(run.ended());
}

TEST(RecordedRun, ObservesInstantsWithoutRecordingThem) {
  Model model = toy_model();
  model.simulation.record = 1.0;
  ToyEngine engine(model), bare(model);
  const Trajectory trajectory = propagate(engine, model, {.instants = {0.0, 0.15, 0.18, 0.3, 2.0}});
  std::vector<double> times;
  for (const Observation& instant : trajectory.instants) times.push_back(instant.time);
  EXPECT_THAT(times, ElementsAre(0.0, 0.2, 0.2, 3 * 0.1)) << "the last never comes";
  EXPECT_THAT(sample_times(trajectory), ElementsAre(0.0, 1.0));
  propagate(bare, model);
  EXPECT_EQ(engine.final_state, bare.final_state);
}

TEST(Propagate, EndsABareRunWhenTold) {
  const Model model = toy_model();
  ToyEngine engine(model);
  std::atomic<bool> stop = false;
  engine.mischief = [&stop](double time, auto) { stop = time > 0.37; };
  EXPECT_EQ(propagate_bare(engine, model, &stop).accepted, 4);
}

TEST(Propagate, CountsStepsAndEvaluationsOfAFixedStepMethod) {
  const Model model = toy_model();
  ToyEngine engine(model);
  int evaluations = 0;
  engine.mischief = [&evaluations](double, auto) { ++evaluations; };
  const StepCounts counts = propagate_bare(engine, model);
  EXPECT_EQ(counts.accepted, 10);
  EXPECT_EQ(counts.rejected, 0);
  EXPECT_EQ(counts.evaluations, 40);
  EXPECT_EQ(evaluations, 40);
}

TEST(Propagate, HoldsInputsAtTheStartAndAtEveryEventInside) {
  Model model = toy_model();
  push_about_z(model, {{{-1.0, 1.0}, {0.0, 2.0}, {0.33, 3.0}, {1.0, 4.0}}});
  add_oscillator(model, "bob", 1.0, {{{0.2, 1.0}, {0.33, 0.0}}});
  ToyEngine engine(model);
  propagate_bare(engine, model);
  EXPECT_THAT(engine.held_at, ElementsAre(0.0, 0.2, 0.33));
}

/// Seven revolutions with a torque that comes and goes, an oscillator and an orbit.
Model eventful_model(Method method, AttitudeChart chart) {
  Model model = toy_model();
  model.engines.attitude = chart;
  model.simulation.method = method;
  model.simulation.duration = 5.0;
  model.simulation.tolerance.attitude = {1.0e-12, 0.0};
  model.gravity.mu = 3.986e14;
  model.initial.r_BN_N = {7.0e6, 1.0e5, -2.0e5};
  model.initial.v_BN_N = {10.0, 7500.0, 300.0};
  model.initial.omega_BN_B = {0.7, -2.0, 9.0};
  push_about_z(model, {{{0.123, 50.0}, {3.21, -20.0}}});
  add_oscillator(model, "bob", 30.0, {{{0.77, 3.0}}});
  add_oscillator(model, "nod", 4.0);
  return model;
}

class EveryRun : public testing::TestWithParam<std::tuple<Method, AttitudeChart>> {};

INSTANTIATE_TEST_SUITE_P(
    Propagate, EveryRun,
    testing::Combine(testing::Values(Method::kEuler, Method::kRk2, Method::kRk4, Method::kRkf45,
                                     Method::kRkf78),
                     testing::Values(AttitudeChart::kMrp, AttitudeChart::kQuaternion)));

TEST_P(EveryRun, IsBitwiseTheSameRecordedAndBare) {
  const auto [method, chart] = GetParam();
  const Model model = eventful_model(method, chart);
  ToyEngine recorded(model);
  ToyEngine bare(model);
  const Trajectory trajectory = propagate(recorded, model);
  const StepCounts counts = propagate_bare(bare, model);
  ASSERT_EQ(trajectory.status, Trajectory::Status::kComplete) << trajectory.failure;
  EXPECT_EQ(recorded.final_state, bare.final_state);
  EXPECT_EQ(trajectory.counts.evaluations, counts.evaluations);
  EXPECT_EQ(trajectory.counts.accepted, counts.accepted);
  EXPECT_EQ(trajectory.counts.rejected, counts.rejected);
  EXPECT_EQ(trajectory.counts.driven_by, counts.driven_by);
}

TEST_P(EveryRun, RepeatsItselfOnTheSameEngine) {
  const auto [method, chart] = GetParam();
  const Model model = eventful_model(method, chart);
  ToyEngine engine(model);
  propagate_bare(engine, model);
  const std::vector<double> first = engine.final_state;
  propagate_bare(engine, model);
  EXPECT_EQ(engine.final_state, first);
}

/// An oscillator of stiffness 4 pushed by 3 N from t = 1/3 on, from displacement 0.1.
double pushed_oscillator(double t) {
  const double since = t - 1.0 / 3;
  return 0.1 * std::cos(2.0 * t) + (since > 0.0 ? 0.75 * (1.0 - std::cos(2.0 * since)) : 0.0);
}

double oscillator_error(Method method, double step) {
  Model model = toy_model();
  model.simulation.method = method;
  model.simulation.step = step;
  add_oscillator(model, "bob", 4.0, {{{1.0 / 3, 3.0}}});
  ToyEngine engine(model);
  const Trajectory trajectory = propagate(engine, model);
  return std::abs(trajectory.samples.back().joint_position[0] - pushed_oscillator(1.0));
}

TEST(Propagate, KeepsTheOrderAcrossAnEventBetweenMultiplesOfTheStep) {
  EXPECT_NEAR(std::log2(oscillator_error(Method::kRk4, 0.1) / oscillator_error(Method::kRk4, 0.05)),
              4.0, 0.5);
  EXPECT_NEAR(std::log2(oscillator_error(Method::kRk2, 0.1) / oscillator_error(Method::kRk2, 0.05)),
              2.0, 0.3);
  EXPECT_LT(oscillator_error(Method::kRk4, 0.01), 2.0e-9);
}

double adaptive_error(Method method, double tolerance) {
  Model model = toy_model();
  const Tolerance each{tolerance, 0.0};
  model.simulation = {.method = method,
                      .step = 5.0,
                      .duration = 20.0,
                      .record = 5.0,
                      .tolerance = {each, each, each, each, each, each, each}};
  add_oscillator(model, "bob", 4.0);
  ToyEngine engine(model);
  const Trajectory trajectory = propagate(engine, model);
  EXPECT_GT(trajectory.counts.driven_by[static_cast<std::size_t>(Block::kJointRate)], 0);
  EXPECT_EQ(trajectory.t_end, 20.0);
  double worst = 0.0;
  for (const Observation& sample : trajectory.samples)
    worst = std::max(worst, std::abs(sample.joint_position[0] - 0.1 * std::cos(2.0 * sample.time)));
  return worst;
}

TEST(Propagate, MakesAdaptiveErrorsFollowTheTolerance) {
  // The global error goes as tolerance^(p/(p+1)): a little slower than the tolerance itself.
  const auto decades = [](Method method) {
    return std::log10(adaptive_error(method, 1.0e-5) / adaptive_error(method, 1.0e-9));
  };
  EXPECT_NEAR(decades(Method::kRkf45), 4.0, 1.0);
  EXPECT_NEAR(decades(Method::kRkf78), 4.0, 1.0);
  EXPECT_LT(adaptive_error(Method::kRkf78, 1.0e-9), 1.0e-7);
}

TEST(Propagate, KeepsTheBooksOfTorqueAndGravity) {
  Model model = toy_model();
  model.initial.omega_BN_B = {0.0, 0.0, 0.2};
  push_about_z(model, {{{0.25, 60.0}, {0.75, 0.0}}});
  ToyEngine engine(model);
  const Trajectory trajectory = propagate(engine, model);
  // 60 N m for 0.5 s about a moment of 600 kg m^2: 0.05 rad/s more.
  EXPECT_NEAR(trajectory.books.back().angular_impulse_N.z(), 30.0, 1.0e-12);
  EXPECT_NEAR(trajectory.books.back().work, 0.5 * 600.0 * (0.25 * 0.25 - 0.2 * 0.2), 1.0e-12);
  EXPECT_EQ(trajectory.books.back().impulse_N, Vector3d::Zero());
  EXPECT_EQ(trajectory.books.front().work, 0.0);
}

TEST(Propagate, KeepsTheImpulseOfGravityEqualToTheMomentumGained) {
  Model model = eventful_model(Method::kRk4, AttitudeChart::kMrp);
  ToyEngine engine(model);
  const Trajectory trajectory = propagate(engine, model);
  const Vector3d gained =
      750.0 * (trajectory.samples.back().v_BN_N - trajectory.samples.front().v_BN_N);
  EXPECT_LT((trajectory.books.back().impulse_N - gained).norm(), 1.0e-12 * 750.0 * 7500.0);
}

/// Turns the acceleration of the second oscillator into NaN from t = 0.45 on.
void poison(ToyEngine& engine) {
  engine.mischief = [](double time, std::span<double> rate) {
    if (time > 0.45) rate.back() = std::numeric_limits<double>::quiet_NaN();
  };
}

TEST(Propagate, FailsOnNanNamingTimeAndCoordinateAndKeepsTheLastGoodSample) {
  Model model = toy_model();
  add_oscillator(model, "bob", 1.0);
  add_oscillator(model, "nod", 1.0);
  ToyEngine engine(model);
  poison(engine);
  const Trajectory trajectory = propagate(engine, model);
  EXPECT_EQ(trajectory.status, Trajectory::Status::kFailed);
  EXPECT_EQ(trajectory.failure, "`nod.rate` is not finite");
  EXPECT_EQ(trajectory.t_end, 0.4);
  EXPECT_EQ(trajectory.samples.back().time, 0.4);
  EXPECT_TRUE(std::isfinite(trajectory.samples.back().joint_rate[1]));
  EXPECT_THROW(propagate_bare(engine, model), NumericalFailure);
}

TEST(Propagate, FailsOnNanUnderAnAdaptiveMethodToo) {
  Model model = toy_model();
  model.simulation.method = Method::kRkf45;
  add_oscillator(model, "bob", 1.0);
  add_oscillator(model, "nod", 1.0);
  ToyEngine engine(model);
  poison(engine);
  const Trajectory trajectory = propagate(engine, model);
  EXPECT_EQ(trajectory.status, Trajectory::Status::kFailed);
  EXPECT_THAT(trajectory.failure, HasSubstr("`nod.rate` is not finite at t = 0.4"));
  EXPECT_GT(trajectory.samples.size(), 1u);
}

TEST(Propagate, PassesOnTheFailureOfAnEngine) {
  const Model model = toy_model();
  ToyEngine engine(model);
  engine.mischief = [](double time, auto) {
    if (time > 0.65) throw NumericalFailure("the toy broke");
  };
  const Trajectory trajectory = propagate(engine, model);
  EXPECT_EQ(trajectory.status, Trajectory::Status::kFailed);
  EXPECT_EQ(trajectory.failure, "the toy broke");
  EXPECT_NEAR(trajectory.t_end, 0.6, 1.0e-15);
}

TEST(Propagate, EndsWithTheStateReachedWhenInterrupted) {
  for (const Method method : {Method::kRk4, Method::kRkf45}) {
    Model model = toy_model();
    model.simulation.method = method;
    model.simulation.step = 0.25;
    model.simulation.record = 1.0;
    ToyEngine engine(model);
    std::atomic<bool> stop = false;
    engine.mischief = [&stop](double time, auto) { stop = stop || time > 0.3; };
    const Trajectory trajectory = propagate(engine, model, {&stop, {}});
    EXPECT_EQ(trajectory.status, Trajectory::Status::kInterrupted);
    EXPECT_THAT(sample_times(trajectory), ElementsAre(0.0, 0.5));
    EXPECT_EQ(trajectory.t_end, 0.5);
  }
}

TEST(Propagate, StopsInsideALongAdaptiveInterval) {
  Model model = toy_model();
  model.simulation.method = Method::kRkf45;
  model.simulation.step = model.simulation.duration = 1000.0;
  model.simulation.record = 1000.0;
  add_oscillator(model, "bob", 4.0);
  ToyEngine engine(model);
  std::atomic<bool> stop = false;
  int evaluations = 0;
  engine.mischief = [&](double, auto) { stop = ++evaluations > 600; };
  const Trajectory trajectory = propagate(engine, model, {&stop, {}});
  EXPECT_EQ(trajectory.status, Trajectory::Status::kInterrupted);
  EXPECT_LT(evaluations, 610);
  EXPECT_GT(trajectory.t_end, 0.0);
  EXPECT_LT(trajectory.t_end, 1000.0);
  EXPECT_EQ(trajectory.samples.back().time, trajectory.t_end);
}

TEST(Propagate, RejectsATrialStepThatTheEngineCannotEvaluate) {
  for (const AttitudeChart chart : {AttitudeChart::kMrp, AttitudeChart::kQuaternion}) {
    Model model = toy_model();
    model.engines.attitude = chart;
    model.simulation.method = Method::kRkf78;
    ToyEngine engine(model);
    const Trajectory smooth = propagate(engine, model);
    int evaluations = 0;
    engine.mischief = [&](double, auto) {
      if (++evaluations == 8) throw NumericalFailure("the mass matrix is singular");
    };
    const Trajectory trajectory = propagate(engine, model);
    EXPECT_EQ(trajectory.status, Trajectory::Status::kComplete) << trajectory.failure;
    EXPECT_EQ(trajectory.counts.rejected, smooth.counts.rejected + 1);
  }
}

TEST(Propagate, FailsInTheEnginesOwnWordsWhenNoStepIsShortEnough) {
  Model model = toy_model();
  ToyEngine engine(model);
  engine.mischief = [](double time, auto) {
    if (time > 0.35) throw NumericalFailure("the mass matrix is singular");
  };
  model.simulation.method = Method::kRkf45;
  const Trajectory adaptive = propagate(engine, model);
  EXPECT_EQ(adaptive.status, Trajectory::Status::kFailed);
  EXPECT_EQ(adaptive.failure, "the mass matrix is singular, however short the step");
  EXPECT_NEAR(adaptive.t_end, 0.35, model.simulation.step);
  model.simulation.method = Method::kRk4;
  EXPECT_EQ(propagate(engine, model).failure, "the mass matrix is singular");
}

TEST(Propagate, ReportsProgressNowAndThen) {
  Model model = toy_model();
  model.simulation.step = 1.0e-5;
  model.simulation.record = 1.0;
  ToyEngine engine(model);
  std::vector<double> reported;
  std::atomic<bool> stop = false;
  const auto progress = [&](double time) {
    reported.push_back(time);
    stop = true;
  };
  // One report is proof enough, and the run is long enough for it on any machine.
  model.simulation.duration = 1.0e4;
  propagate(engine, model, {&stop, progress});
  ASSERT_EQ(reported.size(), 1u);
  EXPECT_GT(reported[0], 0.0);
}

}  // namespace
}  // namespace twincraft
