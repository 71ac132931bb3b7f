#include <gtest/gtest.h>
#include <twincraft/testing.h>

TEST(Vehicle, IsTheSameMachineInBothEngines) { EXPECT_TRUE(twincraft::proves(VEHICLE)); }

TEST(Vehicle, FliesAlikeInBothEngines) { EXPECT_TRUE(twincraft::agrees(VEHICLE)); }

TEST(Vehicle, FliesAlikeWithASoftWing) {
  EXPECT_TRUE(twincraft::agrees(VEHICLE, {"panels.wing.stiffness=40 N m/rad"}));
}
