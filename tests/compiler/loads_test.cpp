// Loads: where and when they act.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compiler/components/load.h"
#include "tests/compiler/trial.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Load, ActsAtTheMountsOriginUnlessAPointIsNamed) {
  const Trial trial(brick_with(R"(loads:
  - {name: a, force: [1, 2, 3]}
  - {name: b, force: [1, 2, 3], position: [0, 0, -1.5]}
  - {name: c, force: [1, 2, 3], position: com}
)"));
  ASSERT_TRUE(trial.model);
  EXPECT_EQ(trial.model->loads.at(0).r_FL_L, Vector3d(0.0, 0.0, 0.0));
  EXPECT_EQ(trial.model->loads.at(1).r_FL_L, Vector3d(0.0, 0.0, -1.5));
  EXPECT_EQ(trial.model->loads.at(2).r_FL_L, std::nullopt);
  EXPECT_EQ(trial.model->loads.at(0).force_L[2].at(0.0), 3.0);
  EXPECT_TRUE(trial.model->loads.at(0).torque_L[0].is_zero());
}

TEST(Load, ActsInsideItsIntervalsOnly) {
  const Trial trial(brick_with(
      "loads: [{name: push, torque: [0.2, 0, 0], during: [[10 s, 20 s], [30 s, 40 s]]}]\n"));
  ASSERT_TRUE(trial.model);
  const Schedule& torque = trial.model->loads.at(0).torque_L[0];
  EXPECT_EQ(torque.at(0.0), 0.0);
  EXPECT_EQ(torque.at(10.0), 0.2);
  EXPECT_EQ(torque.at(20.0), 0.0);
  EXPECT_EQ(torque.at(35.0), 0.2);
}

TEST(Load, RefusesPointsAndMountsThatDoNotExist) {
  const Trial trial(brick_with("loads:\n  - {name: push, force: [1, 0, 0], mount: wing}\n"));
  EXPECT_THAT(trial.faults(),
              ElementsAre(HasSubstr("9:43 SC3003 load `push` is mounted on unknown `wing`")));
  const Trial word(brick_with("loads:\n  - {name: push, force: [1, 0, 0], position: origin}\n"));
  EXPECT_THAT(word.codes(), ElementsAre(Code::kUnknownWord));
}

}  // namespace
}  // namespace twincraft
