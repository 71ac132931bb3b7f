// Claims about the metrics and the verdict, on trajectories written by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "compiler/ir/angle.h"
#include "runtime/study/member.h"
#include "tests/runtime/handmade.h"

namespace twincraft {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kDegrees = 180.0 / std::numbers::pi;

Quaterniond turn(double angle, const Vector3d& axis) {
  return Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

const Metric* find(const Comparison& comparison, const std::string& key) {
  const auto found = std::find_if(comparison.metrics.begin(), comparison.metrics.end(),
                                  [&](const Metric& metric) { return metric.key == key; });
  return found == comparison.metrics.end() ? nullptr : &*found;
}

class Comparing : public testing::Test {
 protected:
  const Metric& metric(const std::string& key) {
    comparison = compare(model, a, b);
    const Metric* found = find(comparison, key);
    if (found == nullptr) throw std::out_of_range(key);
    return *found;
  }
  Verdict verdict() {
    Member member;
    member.comparison = compare(model, a, b);
    member.complete =
        a.status == Trajectory::Status::kComplete && b.status == Trajectory::Status::kComplete;
    return member.verdict();
  }

  Model model = test::model_of_every_kind();
  Trajectory a = test::standstill(model);
  Trajectory b = test::standstill(model);
  Comparison comparison;
};

TEST(PrincipalAngle, SeesARotationOfAPicoradian) {
  const Quaterniond start = turn(2.0, {1.0, -2.0, 0.5});
  const Quaterniond end = start * turn(1.0e-12, {0.3, 0.4, -1.0});
  // Entries of the quaternions are rounded at 1e-16, which an angle of 1e-12 shows as 4e-4 of it.
  EXPECT_NEAR(principal_angle(start, end), 1.0e-12, 5.0e-16);
}

TEST(PrincipalAngle, KeepsRelativeAccuracyNearTheIdentity) {
  const Quaterniond tiny(1.0, 0.5e-30, 0.0, 0.0);
  EXPECT_DOUBLE_EQ(principal_angle(Quaterniond::Identity(), tiny), 1.0e-30);
}

TEST(PrincipalAngle, OfAnAttitudeAndItselfIsZeroToRounding) {
  const Quaterniond q = turn(1.234, {3.0, -2.0, 1.0});
  EXPECT_LT(principal_angle(q, q), 1.0e-15);
}

TEST(PrincipalAngle, TakesAQuaternionAndItsNegativeAsOneAttitude) {
  const Quaterniond q = turn(1.2, {1.0, 1.0, 0.0});
  const Quaterniond negative(-q.w(), -q.x(), -q.y(), -q.z());
  EXPECT_LT(principal_angle(q, negative), 1.0e-15);
}

TEST(PrincipalAngle, ReachesHalfATurnAndNoFurther) {
  EXPECT_NEAR(principal_angle(Quaterniond::Identity(), turn(3.0, {0.0, 0.0, 1.0})), 3.0, 1.0e-15);
  EXPECT_NEAR(principal_angle(Quaterniond::Identity(), turn(4.0, {0.0, 0.0, 1.0})),
              2.0 * std::numbers::pi - 4.0, 1.0e-14);
}

TEST_F(Comparing, ReportsTheLargestDifferenceAndWhenItFirstOccurred) {
  b.samples[1].r_CN_N = {3.0e-3, 0.0, 4.0e-3};
  b.samples[2].r_CN_N = {3.0e-3, 0.0, 4.0e-3};
  EXPECT_DOUBLE_EQ(metric("com_position_m").maximum, 5.0e-3);
  EXPECT_EQ(metric("com_position_m").at, 0.5);
  EXPECT_EQ(metric("position_m").maximum, 0.0);
}

TEST_F(Comparing, HoldsHubsOfUnlikeVehiclesAgainstEachOther) {
  Model bare;
  Trajectory other = test::standstill(bare);  // neither joints nor wheels
  other.samples[1].q_BN = turn(0.25, {0, 0, 1});
  const Comparison hubs = compare_hubs(false, a, other);
  EXPECT_TRUE(hubs.same_times);
  for (const Metric& metric : hubs.metrics) EXPECT_EQ(metric.tolerance, std::nullopt);
  ASSERT_NE(find(hubs, "attitude_deg"), nullptr);
  EXPECT_NEAR(find(hubs, "attitude_deg")->maximum, 0.25 * kDegrees, 1e-12);
  EXPECT_EQ(find(hubs, "attitude_deg")->at, 0.5);
  EXPECT_EQ(find(hubs, "joint_deg"), nullptr);
}

TEST_F(Comparing, HoldsPointMassesAgainstEachOtherByPlaceAlone) {
  b.samples[2].r_CN_N = Vector3d(3, 0, 4);
  const Comparison hubs = compare_hubs(true, a, b);
  EXPECT_EQ(find(hubs, "attitude_deg"), nullptr);
  ASSERT_NE(find(hubs, "com_position_m"), nullptr);
  EXPECT_EQ(find(hubs, "com_position_m")->maximum, 5.0);
}

TEST_F(Comparing, LooksAtTheLastSample) {
  b.samples[2].omega_BN_B.y() = 2.0e-9;
  EXPECT_EQ(metric("rate_rad_s").maximum, 2.0e-9);
  EXPECT_EQ(metric("rate_rad_s").at, 1.0);
}

TEST_F(Comparing, GivesAttitudeInDegrees) {
  b.samples[1].q_BN = turn(1.0e-9, {1.0, 2.0, 3.0});
  EXPECT_NEAR(metric("attitude_deg").maximum, 1.0e-9 * kDegrees, 1.0e-14);
}

TEST_F(Comparing, TakesTheNormOverPanelAndBodyAngles) {
  b.samples[1].joint_position = {2.0e-6, 3.0e-6, 6.0e-6, 1.0, 1.0, 1.0, 1.0};
  EXPECT_NEAR(metric("joint_deg").maximum, 7.0e-6 * kDegrees, 1.0e-18);
}

TEST_F(Comparing, TakesTheNormOverWheels) {
  b.samples[1].wheel_rate = {3.0e-9, -4.0e-9};
  EXPECT_NEAR(metric("wheel_rate_rad_s").maximum, 5.0e-9, 1.0e-24);
}

TEST_F(Comparing, TakesTheWorstPendulumAngleAndEveryLengthInMetres) {
  b.samples[1].joint_position = {0.0, 0.0, 0.0, 0.25, -0.5, 3.0e-6, -4.0e-6};
  EXPECT_NEAR(metric("pendulum_deg").maximum, 4.0e-6 * kDegrees, 1.0e-18);
  EXPECT_EQ(metric("joint_m").maximum, 0.25);
  EXPECT_EQ(metric("slosh_m").maximum, 0.5);
}

TEST_F(Comparing, JudgesAnglesByJointAndDisplacementsByTravel) {
  model.agreement.joint = 1.0e-9;
  model.agreement.travel = 1.0e-3;
  b.samples[1].joint_position[3] = 0.9e-3;  // `rail`
  EXPECT_EQ(metric("joint_m").tolerance, 1.0e-3);
  EXPECT_NEAR(*metric("joint_deg").tolerance, 1.0e-9 * kDegrees, 1.0e-22);
  EXPECT_EQ(verdict(), Verdict::kAgree);
  b.samples[1].joint_position[3] = 1.1e-3;
  EXPECT_EQ(verdict(), Verdict::kDisagree);
  model.agreement.travel.reset();
  EXPECT_EQ(verdict(), Verdict::kAgree);
}

TEST_F(Comparing, LeavesOutMetricsThatDoNotApply) {
  model = Model{};
  model.assembly.links.resize(1);
  a = test::standstill(model);
  b = test::standstill(model);
  const Comparison bare = compare(model, a, b);
  for (const char* key : {"joint_deg", "joint_m", "wheel_rate_rad_s", "slosh_m", "pendulum_deg"})
    EXPECT_EQ(find(bare, key), nullptr) << key;
  for (const char* key :
       {"attitude_deg", "rate_rad_s", "position_m", "velocity_m_s", "com_position_m", "mass_kg"})
    EXPECT_NE(find(bare, key), nullptr) << key;
}

TEST_F(Comparing, JudgesPositionByTheSystemsCentreOfMass) {
  model.agreement.position = 1.0e-6;
  b.samples[1].r_BN_N.x() = 1.0;
  EXPECT_EQ(verdict(), Verdict::kAgree);
  EXPECT_FALSE(metric("position_m").pass().has_value());
  b.samples[1].r_CN_N.x() = 2.0e-6;
  EXPECT_EQ(verdict(), Verdict::kDisagree);
}

TEST_F(Comparing, ShowsAnglesAndTheirTolerancesInOneUnit) {
  model.agreement.attitude = 2.0e-9;
  b.samples[1].q_BN = turn(1.9e-9, {0.0, 0.0, 1.0});
  EXPECT_NEAR(*metric("attitude_deg").tolerance, 2.0e-9 * kDegrees, 1.0e-22);
  EXPECT_EQ(metric("attitude_deg").pass(), true);
}

TEST_F(Comparing, HoldsAtExactlyTheTolerance) {
  model.agreement.mass = 0.5;
  b.samples[2].mass += 0.5;
  EXPECT_EQ(verdict(), Verdict::kAgree);
}

TEST_F(Comparing, IsNotJudgedWithoutTolerances) { EXPECT_EQ(verdict(), Verdict::kNotJudged); }

TEST_F(Comparing, NeverPassesANaN) {
  model.agreement.rate = 1.0;
  b.samples[1].omega_BN_B.x() = kNaN;
  EXPECT_TRUE(std::isnan(metric("rate_rad_s").maximum));
  EXPECT_EQ(metric("rate_rad_s").at, 0.5);
  EXPECT_EQ(verdict(), Verdict::kDisagree);
}

TEST_F(Comparing, NeverPassesANaNInOneOfManyCoordinates) {
  model.agreement.slosh = model.agreement.joint = 1.0;
  b.samples[1].joint_position[6] = kNaN;  // bob.theta
  EXPECT_EQ(metric("pendulum_deg").pass(), false);
  EXPECT_EQ(metric("slosh_m").pass(), true);
}

TEST_F(Comparing, NeedsBothRunsToTheEnd) {
  model.agreement.rate = 1.0e-9;
  b.status = Trajectory::Status::kInterrupted;
  b.samples.pop_back();
  EXPECT_EQ(verdict(), Verdict::kInterrupted);
  b.samples[1].omega_BN_B.x() = 1.0;
  EXPECT_EQ(verdict(), Verdict::kInterrupted);
}

TEST_F(Comparing, ComparesOnlySamplesOfTheSameInstant) {
  model.agreement.position = 1.0e-3;
  b.samples[2].time = 0.75;
  b.samples[2].r_CN_N.x() = 1.0;
  comparison = compare(model, a, b);
  EXPECT_FALSE(comparison.same_times);
  EXPECT_EQ(verdict(), Verdict::kNotJudged);
  EXPECT_EQ(find(comparison, "com_position_m")->maximum, 0.0);
}

TEST_F(Comparing, OfNothingIsNotJudged) {
  model.agreement.rate = 1.0;
  b.samples.clear();
  comparison = compare(model, a, b);
  EXPECT_TRUE(comparison.metrics.empty());
  EXPECT_FALSE(comparison.same_times);
  EXPECT_EQ(verdict(), Verdict::kNotJudged);
}

}  // namespace
}  // namespace twincraft
