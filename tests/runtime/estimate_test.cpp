// Claims about what is known of a run before it starts.
#include "runtime/delivery/estimate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/runtime/handmade.h"

namespace twincraft {
namespace {

using testing::HasSubstr;

Model recorded_every(double record) {
  Model model = test::model_of_every_kind();
  model.simulation.step = 0.001;
  model.simulation.duration = 1000.0;
  model.simulation.record = record;
  return model;
}

TEST(Estimate, CountsTheSamplesThatAreRecorded) {
  EXPECT_NEAR(samples_of(recorded_every(0.01)), 1.0e5, 10.0);
  EXPECT_NEAR(samples_of(recorded_every(1.0e-9)), 1.0e6, 10.0) << "no more than there are steps";
}

TEST(Estimate, IsNoLessThanWhatASampleHolds) {
  const Model model = recorded_every(0.001);
  const double held = sizeof(Observation) + 8.0 * (7 + 7 + 2);
  EXPECT_GT(trajectory_bytes(model), 1.0e6 * held);
  EXPECT_LT(trajectory_bytes(model), 3.0e6 * held);
}

TEST(Estimate, NamesARecordWithWhichARunFits) {
  Model model = recorded_every(0.001);
  const double trajectories = 40.0;
  ASSERT_GT(trajectories * trajectory_bytes(model), kMostMemory);
  model.simulation.record = record_that_fits(model, trajectories);
  EXPECT_LT(trajectories * trajectory_bytes(model), kMostMemory);
  EXPECT_GT(trajectories * trajectory_bytes(model), 0.8 * kMostMemory);
}

TEST(Estimate, RefusesFilesForWhichTheDiskHasNoRoom) {
  EXPECT_EQ(check_room("out", 1.0e9, 2.0e9, 0.1), "");
  const std::string refusal = check_room("out", 3.0 * 1024 * 1024 * 1024, 1.0e6, 0.1);
  EXPECT_THAT(refusal, HasSubstr("cannot write `out`: the files of this run take 3 GiB or more, "
                                 "and 977 KiB are free"));
  EXPECT_THAT(refusal, HasSubstr("raise `simulation.record` from 0.1 s"));
}

TEST(Estimate, AsksTheFileSystemThatAFolderWillBeOn) {
  EXPECT_GT(free_bytes("."), 0.0);
  EXPECT_GT(free_bytes(testing::TempDir() + "not/yet/there"), 0.0);
}

}  // namespace
}  // namespace twincraft
