// Claims about the balances, on trajectories and books written by hand.
#include "runtime/compare/conservation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/runtime/handmade.h"

namespace twincraft {
namespace {

class Balance : public testing::Test {
 protected:
  Trajectory trajectory = test::standstill(Model{});
  Observation& sample(std::size_t i) { return trajectory.samples[i]; }
  Books& books(std::size_t i) { return trajectory.books[i]; }
};

TEST_F(Balance, OfAVehicleAtRestIsExact) {
  const Conservation kept = conservation_of(trajectory);
  EXPECT_EQ(kept.energy, 0.0);
  EXPECT_EQ(kept.momentum, 0.0);
  EXPECT_EQ(kept.angular_momentum, 0.0);
}

TEST_F(Balance, GivesEnergyThatCameFromOutsideItsDue) {
  sample(1).kinetic = 3.0;
  sample(1).potential = 1.0;
  books(1).work = 4.0;
  sample(2).kinetic = 10.0;
  books(2).work = 9.0;
  EXPECT_DOUBLE_EQ(conservation_of(trajectory).energy, 1.0 / 10.0);
}

TEST_F(Balance, FindsTheWorstSampleNotTheLast) {
  for (std::size_t i : {0u, 1u, 2u}) sample(i).potential = -8.0;
  sample(1).potential = -10.0;
  EXPECT_DOUBLE_EQ(conservation_of(trajectory).energy, 2.0 / 10.0);
}

TEST_F(Balance, IsRelativeToKineticEnergyWhenTheTotalCancels) {
  for (std::size_t i : {0u, 1u, 2u}) {
    sample(i).kinetic = 50.0;
    sample(i).potential = -50.0;
  }
  sample(2).potential += 1.0e-9;
  EXPECT_NEAR(conservation_of(trajectory).energy, 2.0e-11, 1.0e-16);
}

TEST_F(Balance, GivesMomentumItsImpulse) {
  sample(2).momentum = {3.0, 4.0, 0.0};
  sample(2).momentum_scale = 20.0;
  EXPECT_DOUBLE_EQ(conservation_of(trajectory).momentum, 5.0 / 20.0);
  books(2).impulse_N = {3.0, 4.0, 0.0};
  EXPECT_EQ(conservation_of(trajectory).momentum, 0.0);
}

TEST_F(Balance, OfAVehicleAtRestWithASpinningWheelIsRelativeToItsAngularMomentum) {
  for (std::size_t i : {0u, 1u, 2u}) sample(i).H_scale = 25.0;
  sample(2).momentum = {5.0e-18, 0.0, 0.0};
  sample(2).momentum_scale = 1.0e-10;  // a token mass on a hub that turns a little
  EXPECT_NEAR(conservation_of(trajectory).momentum, 2.0e-19, 1.0e-30);
  sample(2).momentum_scale = 1.0e-3;
  EXPECT_NEAR(conservation_of(trajectory).momentum, 5.0e-15, 1.0e-23);
}

TEST_F(Balance, OfAVehicleThatDoesNotTurnIsRelativeToItsImpulseOnAnArm) {
  // Rounding of torques is all there is, beside forces that are far larger.
  books(2).impulse_N = {0.0, 0.0, 20.0};
  sample(2).momentum = books(2).impulse_N;
  sample(2).momentum_scale = 20.0;
  books(2).angular_impulse_N = {1.0e-15, 0.0, 0.0};
  EXPECT_NEAR(conservation_of(trajectory).angular_momentum, 5.0e-17, 1.0e-30);
  sample(2).H_scale = 1.0e-16;  // rounding too
  EXPECT_NEAR(conservation_of(trajectory).angular_momentum, 5.0e-17, 1.0e-30);
  books(2).impulse_N.setZero();  // a mass that slides through the centre
  EXPECT_NEAR(conservation_of(trajectory).angular_momentum, 5.0e-17, 1.0e-30);
  sample(2).H_scale = 1.0e-6;  // a slow turn, and a scale
  EXPECT_NEAR(conservation_of(trajectory).angular_momentum, 1.0e-9, 1.0e-20);
}

TEST_F(Balance, OfOpposedWheelsIsRelativeToWhatEachCarries) {
  for (std::size_t i : {0u, 1u, 2u}) sample(i).H_scale = 100.0;  // +50 and -50: H is zero
  sample(1).H_PntC_N.z() = 1.0e-13;
  EXPECT_DOUBLE_EQ(conservation_of(trajectory).angular_momentum, 1.0e-15);
  books(1).angular_impulse_N.z() = 1.0e-13;
  EXPECT_EQ(conservation_of(trajectory).angular_momentum, 0.0);
}

TEST_F(Balance, ThatIsNoNumberStaysNone) {
  sample(1).kinetic = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(conservation_of(trajectory).energy));
}

TEST_F(Balance, OfNoSamplesIsEmpty) { EXPECT_EQ(conservation_of(Trajectory{}).energy, 0.0); }

}  // namespace
}  // namespace twincraft
