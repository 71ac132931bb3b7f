// Gravity, the controls of both engines, and what a run is judged by.
#include "compiler/spec/engines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/compiler/trial.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kFar = "initial: {position: [7000 km, 0, 0]}\n";

TEST(Engines, AreTheSameMachineByDefault) {
  const Trial trial(brick_with(""));
  ASSERT_TRUE(trial.model);
  EXPECT_EQ(trial.model->engines.attitude, AttitudeChart::kMrp);
  EXPECT_EQ(trial.model->engines.chains, ChainPath::kPlanar);
  EXPECT_EQ(trial.model->engines.frame, MujocoFrame::kComoving);
  EXPECT_EQ(trial.model->engines.wheel_mass, 1.0e-6);
  EXPECT_TRUE(trial.model->engines.compensate);
  EXPECT_EQ(trial.model->gravity.bsm, GravityLaw::kNone);
  EXPECT_EQ(trial.model->gravity.mujoco, GravityLaw::kNone);
}

TEST(Engines, EliminateChainsAsTheSpecSays) {
  const Trial trial(brick_with("engines: {bsm: {chains: general}}\n"));
  ASSERT_TRUE(trial.model);
  EXPECT_EQ(trial.model->engines.chains, ChainPath::kGeneral);
}

TEST(Engines, ApplyGravityAsTheEnvironmentSaysUnlessOverridden) {
  const std::string gravity =
      "environment: {gravity: {mu: 398600.436 km3/s2, application: body_gradient}}\n";
  const Trial both(brick_with(gravity + kFar));
  ASSERT_TRUE(both.model);
  EXPECT_DOUBLE_EQ(both.model->gravity.mu, 3.98600436e14);
  EXPECT_EQ(both.model->gravity.bsm, GravityLaw::kBodyGradient);
  EXPECT_EQ(both.model->gravity.mujoco, GravityLaw::kBodyGradient);
  const Trial apart(brick_with(gravity + kFar + "engines: {bsm: {gravity: system_com}}\n"));
  ASSERT_TRUE(apart.model);
  EXPECT_EQ(apart.model->gravity.bsm, GravityLaw::kSystemCom);
  EXPECT_EQ(apart.model->gravity.mujoco, GravityLaw::kBodyGradient);
}

TEST(Engines, CannotOverrideAGravityThatIsNotThere) {
  const Trial trial(brick_with("engines: {mujoco: {gravity: body_com}}\n"));
  EXPECT_THAT(trial.faults(),
              ElementsAre(HasSubstr("8:29 SC3301 a law of gravity, but the spec has no")));
}

TEST(Engines, RefuseATokenMassThatTheMountCannotSpare) {
  const std::string wheel =
      "wheels: [{name: rw, axis: [0, 0, 1], spin_inertia: 0.08, transverse_inertia: 0.04}]\n";
  const Trial heavy(brick_with(wheel + "engines: {mujoco: {wheel_mass: 600 kg}}\n"));
  EXPECT_THAT(heavy.codes(), ElementsAre(Code::kTokenMassTooLarge));
  EXPECT_EQ(heavy.diagnostics.all().at(0).span.line, 9);
  EXPECT_FALSE(heavy.model);
  const Trial on_top(
      brick_with(wheel + "engines: {mujoco: {wheel_mass: 600 kg, compensate: false}}\n"));
  EXPECT_THAT(on_top.faults(), IsEmpty());
  const Trial nothing(brick_with("engines: {mujoco: {wheel_mass: 1.0e-16}}\n"));
  EXPECT_THAT(nothing.codes(), ElementsAre(Code::kMassTooSmall));
}

TEST(Environment, RefusesAnAttractingBodyThatRepels) {
  const Trial trial(brick_with(std::string("environment: {gravity: {mu: -1}}\n") + kFar));
  EXPECT_THAT(trial.codes(), ElementsAre(Code::kOutOfRange));
}

TEST(Agreement, JudgesOnlyWhatHasATolerance) {
  const Trial trial(brick_with("agreement: {attitude: 1.0e-9 deg, position: 1 um}\n"));
  ASSERT_TRUE(trial.model);
  EXPECT_DOUBLE_EQ(trial.model->agreement.attitude.value(), 1.0e-9 * kDegree);
  EXPECT_DOUBLE_EQ(trial.model->agreement.position.value(), 1.0e-6);
  EXPECT_EQ(trial.model->agreement.rate, std::nullopt);
}

TEST(Agreement, JudgesAnglesAndTravelInUnitsOfTheirOwn) {
  const Trial trial(brick_with("agreement: {joint: 1 deg, travel: 1 mm}\n"));
  ASSERT_TRUE(trial.model);
  EXPECT_DOUBLE_EQ(trial.model->agreement.joint.value(), kDegree);
  EXPECT_DOUBLE_EQ(trial.model->agreement.travel.value(), 1.0e-3);
  EXPECT_THAT(Trial(brick_with("agreement: {joint: 1 mm}\n")).codes(),
              ElementsAre(Code::kBadQuantity));
  EXPECT_THAT(Trial(brick_with("agreement: {travel: 1 deg}\n")).codes(),
              ElementsAre(Code::kBadQuantity));
}

TEST(Agreement, JudgesBalancesByPlainNumbers) {
  const Trial trial(brick_with("agreement: {energy: 1.0e-9, momentum: 0, angular_momentum: 2}\n"));
  ASSERT_TRUE(trial.model);
  EXPECT_EQ(trial.model->agreement.energy, 1.0e-9);
  EXPECT_EQ(trial.model->agreement.momentum, 0.0);
  EXPECT_EQ(trial.model->agreement.angular_momentum, 2.0);
  EXPECT_THAT(Trial(brick_with("agreement: {energy: -1}\n")).codes(),
              ElementsAre(Code::kOutOfRange));
}

TEST(Agreement, GivesEveryReferenceTolerancesOfItsOwn) {
  const Trial trial(brick_with(
      "references: [torque_free, spin_up]\n"
      "agreement: {references: {torque_free: {attitude: 1 deg}, spin_up: {rate: 2 rad/s}}}\n"));
  ASSERT_TRUE(trial.model);
  EXPECT_THAT(trial.faults(), IsEmpty());
  const ReferenceTolerances& tolerances = trial.model->agreement.references;
  EXPECT_DOUBLE_EQ(tolerances.torque_free.attitude.value(), kDegree);
  EXPECT_EQ(tolerances.torque_free.rate, std::nullopt);
  EXPECT_EQ(tolerances.spin_up.rate, 2.0);
  EXPECT_EQ(tolerances.spin_up.attitude, std::nullopt);
}

TEST(Agreement, WarnsOfTolerancesThatJudgeNothing) {
  const Trial trial(
      brick_with("references: [spin_up]\n"
                 "agreement: {references: {kepler: {velocity: 1 mm/s}}}\n"));
  EXPECT_TRUE(trial.model);
  EXPECT_THAT(trial.faults(), ElementsAre(HasSubstr("9:34 SC3504 these tolerances judge nothing: "
                                                    "`references` does not list `kepler`")));
}

TEST(References, AreRefusedWhereTheyCannotApply) {
  const Trial kepler(brick_with("references: [kepler]\n"));
  EXPECT_THAT(kepler.faults(),
              ElementsAre(HasSubstr("8:14 SC3501 `kepler` does not apply: there is no gravity")));
  const Trial spin_up(brick_with(
      "references: [spin_up]\n"
      "wheels: [{name: rw, axis: [0, 0, 1], spin_inertia: 0.08, transverse_inertia: 0.04}]\n"));
  EXPECT_THAT(spin_up.codes(), ElementsAre(Code::kReferenceInapplicable));
  const Trial second(brick_with("references: [torque_free, tsiolkovsky]\n"));
  EXPECT_THAT(second.faults(), ElementsAre(HasSubstr("8:27 SC3501 `tsiolkovsky` does not apply: no "
                                                     "tank drains")));
  const Trial rigid(brick_with("references: [spin_up]\n"));
  ASSERT_TRUE(rigid.model);
  EXPECT_THAT(rigid.model->references, ElementsAre(ReferenceKind::kSpinUp));
}

TEST(References, MustApplyUnderTheGravityLawOfEitherEngine) {
  const std::string orbit =
      "environment: {gravity: {mu: 3.986e14, application: system_com}}\nreferences: [spin_up]\n"
      "initial: {position: [7000 km, 0, 0]}\n";
  EXPECT_THAT(Trial(brick_with(orbit)).faults(), IsEmpty());
  const Trial apart(brick_with(orbit + "engines: {mujoco: {gravity: body_gradient}}\n"));
  EXPECT_THAT(apart.faults(), ElementsAre(HasSubstr("9:14 SC3501 `spin_up` does not apply: gravity "
                                                    "turns the vehicle")));
}

}  // namespace
}  // namespace twincraft
