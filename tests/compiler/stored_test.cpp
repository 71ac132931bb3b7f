// States of a truth that a spec brings along: what is read, and what is refused.
#include "compiler/spec/stored.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/compiler/trial.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string stored(const std::string& states, const std::string& more = "") {
  return brick_with("references: [stored]\nstored:\n  source: check case\n" + more + "  states:\n" +
                    states);
}

TEST(Stored, TakesWhatIsKnownInAnyUnitAndForm) {
  const Trial trial(
      stored("    - {time: 1 min, position: [7000 km, 0, 0], rate: [0, 6 rpm, 0]}\n"
             "    - {time: 120, attitude: {quaternion_to_body: [0.6, 0, -0.8, 0]}}\n",
             "  point: hub\n  tolerance: {position: 1 mm, attitude: 1 deg}\n"));
  ASSERT_TRUE(trial.model);
  const StoredTruth& truth = trial.model->stored;
  EXPECT_EQ(truth.source, "check case");
  EXPECT_TRUE(truth.of_hub);
  ASSERT_EQ(truth.states.size(), 2u);
  EXPECT_EQ(truth.states[0].time, 60.0);
  EXPECT_EQ(truth.states[0].position, Vector3d(7.0e6, 0.0, 0.0));
  EXPECT_FALSE(truth.states[0].velocity);
  EXPECT_NEAR(truth.states[0].omega_BN_B->y(), 36.0 * kDegree, 1.0e-15);
  EXPECT_FALSE(truth.states[0].q_BN);
  // N to B turns by the opposite of B to N.
  EXPECT_EQ(truth.states[1].q_BN->coeffs(), Quaterniond(0.6, 0.0, 0.8, 0.0).coeffs());
  EXPECT_DOUBLE_EQ(truth.position.value(), 1.0e-3);
  EXPECT_DOUBLE_EQ(truth.attitude.value(), kDegree);
  EXPECT_FALSE(truth.velocity);
  EXPECT_FALSE(truth.rate);
}

TEST(Stored, AlignsWithTheOrbitOfTheStateItself) {
  const std::string gravity =
      "environment: {gravity: {mu: 3.986e14}}\ninitial: {position: [7000 km, 0, 0]}\n";
  const std::string align = "attitude: {align: [{axis: x, to: radial}, {axis: z, to: velocity}]}";
  const Trial trial(stored("    - {time: 1, position: [0, 7000 km, 0], velocity: [0, 0, 7 km/s], " +
                           align + "}\n") +
                    gravity);
  ASSERT_TRUE(trial.model);
  const Quaterniond q_BN = trial.model->stored.states[0].q_BN.value();
  EXPECT_LT((q_BN * Vector3d::UnitX() - Vector3d::UnitY()).norm(), 1.0e-15);
  EXPECT_LT((q_BN * Vector3d::UnitZ() - Vector3d::UnitZ()).norm(), 1.0e-15);
  EXPECT_THAT(Trial(stored("    - {time: 1, " + align + "}\n") + gravity).codes(),
              ElementsAre(Code::kNeedsGravity, Code::kNeedsGravity));
}

TEST(Stored, ComeInOrderAndInsideTheRun) {
  EXPECT_THAT(Trial(stored("    - {time: 2, rate: [0, 0, 0]}\n    - {time: 2, rate: [0, 0, 0]}\n"))
                  .faults(),
              ElementsAre(HasSubstr("13:14 SC3502 the stored state at 2 s does not come after")));
  EXPECT_THAT(Trial(stored("    - {time: 121, rate: [0, 0, 0]}\n")).faults(),
              ElementsAre(HasSubstr("12:14 SC3502 the run ends at 120 s, before")));
  EXPECT_THAT(Trial(stored("    - {time: 120, rate: [0, 0, 0]}\n")).faults(), IsEmpty());
}

TEST(Stored, AreLeftAloneUnlessTheReferencesNameThem) {
  const Trial trial(brick_with(
      "stored: {source: a table, states: [{time: 1 h, rate: [0, 0, 0]}]}\nreferences: []\n"));
  EXPECT_THAT(trial.faults(), IsEmpty());
  ASSERT_TRUE(trial.model);
  EXPECT_THAT(trial.model->stored.states, IsEmpty());
}

}  // namespace
}  // namespace twincraft
