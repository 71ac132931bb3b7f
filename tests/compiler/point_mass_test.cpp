// `simulation.mode: translation`: what a point mass may be made of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/compiler/trial.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string point_with(const std::string& more) {
  return R"(format: spacecraft/1
name: point
hub: {mass: 600 kg, inertia: [400, 380, 360]}
simulation: {mode: translation, integrator: rk4, step: 0.02 s, duration: 120 s}
)" + more;
}

TEST(PointMass, HasThreeDegreesOfFreedom) {
  const Trial trial(point_with("initial: {position: [1, 2, 3], velocity: [4, 5, 6]}\n"));
  ASSERT_TRUE(trial.model) << trial.faults().front();
  EXPECT_TRUE(trial.model->simulation.translation);
  EXPECT_EQ(trial.model->degrees_of_freedom(), 3);
  EXPECT_EQ(Trial(brick_with("")).model->degrees_of_freedom(), 6);
}

TEST(PointMass, MayBePushedButNotTurned) {
  EXPECT_THAT(
      Trial(point_with("loads: [{name: push, force: [1, 2, 3], position: com}]\n")).faults(),
      IsEmpty());
  EXPECT_THAT(Trial(point_with("loads: [{name: turn, torque: [0, 0, 1]}]\n")).faults(),
              ElementsAre(HasSubstr("5:30 SC3405")));
  EXPECT_THAT(Trial(point_with("initial: {rate: [0, 0, 1]}\n")).faults(),
              ElementsAre(HasSubstr("5:17 SC3405")));
  EXPECT_THAT(Trial(point_with("initial: {attitude: {mrp: [0, 0, 0.1]}}\n")).faults(),
              ElementsAre(HasSubstr("5:21 SC3405")));
  EXPECT_THAT(Trial(point_with("initial: {rate: [0, 0, 0]}\n")).faults(), IsEmpty());
}

TEST(PointMass, CarriesNothing) {
  EXPECT_THAT(Trial(point_with("wheels: [{name: w, axis: [1, 0, 0], spin_inertia: 0.08, "
                               "transverse_inertia: 0.05}]\npanels: []\n"))
                  .faults(),
              ElementsAre(HasSubstr("5:10 SC3405")));
}

TEST(PointMass, IsNoSpinUp) {
  EXPECT_THAT(
      Trial(point_with("references: [spin_up]\n")).faults(),
      ElementsAre(HasSubstr("5:14 SC3501 `spin_up` does not apply: a point mass does not")));
}

TEST(PointMass, IsHeldAgainstStoredPositionsOnly) {
  const std::string stored = "stored: {source: me, states: [{time: 1, ";
  EXPECT_THAT(Trial(point_with(stored + "position: [0, 0, 0]}]}\n")).faults(), IsEmpty());
  EXPECT_THAT(Trial(point_with(stored + "rate: [0, 0, 0]}]}\n")).faults(),
              ElementsAre(HasSubstr("SC3405 a point mass has no rate to compare")));
}

}  // namespace
}  // namespace twincraft
