// Steps, step rules, tolerances and records.
#include "compiler/spec/simulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/compiler/trial.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Line 6 is the simulation; lines 7 to 10 a flexible panel.
std::string run(const std::string& simulation, const std::string& panel = "") {
  return "format: spacecraft/1\nname: flex\nhub:\n  mass: 600\n  inertia: [400, 380, 360]\n"
         "simulation: {" +
         simulation + "}\n" + panel;
}

std::string flexible(int segments, const std::string& stiffness = "600") {
  return "panels:\n  - {name: wing, mass: 60, length: 3, inertia: {shape: bar}, segments: " +
         std::to_string(segments) + ",\n     stiffness: " + stiffness +
         ",\n     hinge: {position: [0.8, 0, 0], axis: [0, -1, 0], outboard: [1, 0, 0]}}\n";
}

constexpr const char* kRule = "step: {per_period: 200, of: wing, maximum: 0.01 s}, duration: 8 s";

TEST(StepRule, GivesThePublishedSteps) {
  const std::pair<int, double> published[] = {
      {1, 0.01},
      {2, 0.006083668013960418},
      {4, 0.0021509014535795535},
      {8, 0.0007604585017450523},
      {16, 0.0002688626816974442},
      {32, 9.505731271813154e-05},
  };
  for (const auto& [segments, step] : published) {
    const Trial trial(run(kRule, flexible(segments)));
    ASSERT_TRUE(trial.model) << segments;
    EXPECT_DOUBLE_EQ(trial.model->simulation.step, step) << segments;
  }
}

TEST(StepRule, TakesTheShortestPeriodOfSeveralSprings) {
  const Trial trial(run(kRule, flexible(2, "[600, 2400]")));
  ASSERT_TRUE(trial.model);
  EXPECT_DOUBLE_EQ(trial.model->simulation.step, 0.006083668013960418 / 2.0);
}

TEST(StepRule, NeedsAPanelWithASpring) {
  const Trial unknown(run("step: {per_period: 200, of: wign}, duration: 8 s", flexible(1)));
  EXPECT_THAT(
      unknown.faults(),
      ElementsAre("6:42 SC3003 `wign` is no panel, particle or pendulum (did you mean `wing`?)"));
  const Trial loose(run(kRule, flexible(1, "0")));
  EXPECT_THAT(loose.codes(), ElementsAre(Code::kNoPeriod));
}

TEST(Simulation, WarnsOfAStepThatDoesNotDivideTheDuration) {
  const Trial warned(run("step: 0.03 s, duration: 1 s"));
  EXPECT_THAT(warned.codes(), ElementsAre(Code::kStepDoesNotDivide));
  EXPECT_EQ(warned.diagnostics.all().at(0).severity, Severity::kWarning);
  EXPECT_THAT(warned.faults().at(0), HasSubstr("6:20 "));
  EXPECT_TRUE(warned.model);
  // 0.1 + 0.1 + 0.1 is not 0.3 in binary, yet 0.1 s divides 0.3 s.
  EXPECT_THAT(Trial(run("step: 0.1 s, duration: 0.3 s")).faults(), IsEmpty());
  const Trial rule(run(kRule, flexible(4)));
  EXPECT_THAT(rule.codes(), ElementsAre(Code::kStepDoesNotDivide));
  EXPECT_EQ(rule.diagnostics.all().at(0).severity, Severity::kNote);
}

TEST(Simulation, RefusesStepsThatCannotBeTaken) {
  EXPECT_THAT(Trial(run("step: 2 s, duration: 1 s")).codes(), ElementsAre(Code::kStepTooLong));
  for (const char* bad : {"step: 0, duration: 1", "step: -1, duration: 1", "step: 1, duration: 0",
                          "step: 1, duration: 10, record: 0"}) {
    EXPECT_THAT(Trial(run(bad)).codes(), ElementsAre(Code::kOutOfRange)) << bad;
  }
}

TEST(Simulation, RecordsAboutTwoHundredWholeStepsUnlessToldOtherwise) {
  const auto record = [](const std::string& simulation) {
    const Trial trial(run(simulation));
    return trial.model ? trial.model->simulation.record : 0.0;
  };
  EXPECT_DOUBLE_EQ(record("step: 0.02 s, duration: 120 s"), 0.6);
  EXPECT_DOUBLE_EQ(record("step: 0.07 s, duration: 140 s"), 0.7);
  EXPECT_DOUBLE_EQ(record("step: 0.5 s, duration: 10 s"), 0.5);
  EXPECT_DOUBLE_EQ(record("step: 0.03 s, duration: 12 s"), 0.06);
  EXPECT_DOUBLE_EQ(record("step: 0.02 s, duration: 120 s, record: 0.5 s"), 0.5);
}

TEST(Simulation, ControlsErrorsAllAlikeOrBlockByBlock) {
  const Trial alike(run("integrator: rkf45, step: 1, duration: 10, tolerance: 1.0e-7"));
  ASSERT_TRUE(alike.model);
  EXPECT_EQ(alike.model->simulation.tolerance.attitude.absolute, 1.0e-7);
  EXPECT_EQ(alike.model->simulation.tolerance.wheel.relative, 1.0e-7);
  const Trial blocks(
      run("integrator: rkf78, step: 1, duration: 10, tolerance: {position: 1.0e-3, "
          "joint: {absolute: 1.0e-6}}"));
  ASSERT_TRUE(blocks.model);
  const BlockTolerances& tolerance = blocks.model->simulation.tolerance;
  EXPECT_EQ(blocks.model->simulation.method, Method::kRkf78);
  EXPECT_EQ(tolerance.position.absolute, 1.0e-3);
  EXPECT_EQ(tolerance.position.relative, 1.0e-3);
  EXPECT_EQ(tolerance.joint.absolute, 1.0e-6);
  EXPECT_EQ(tolerance.joint.relative, 0.0);
  EXPECT_EQ(tolerance.rate.relative, 1.0e-9);
}

TEST(Simulation, RefusesTolerancesThatCannotBeMet) {
  const auto codes = [](const std::string& tolerance) {
    return Trial(run("step: 1, duration: 10, tolerance: " + tolerance)).codes();
  };
  EXPECT_THAT(codes("0"), ElementsAre(Code::kOutOfRange));
  EXPECT_THAT(codes("1.0e-16"), ElementsAre(Code::kToleranceTooSmall));
  EXPECT_THAT(codes("{joint: {absolute: 0, relative: 0}}"), ElementsAre(Code::kToleranceTooSmall));
  EXPECT_THAT(codes("{joint: {absolute: 1.0e-20}}"), IsEmpty());
}

}  // namespace
}  // namespace twincraft
