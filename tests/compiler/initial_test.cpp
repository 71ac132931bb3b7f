// The initial state: orbits, the centre of mass against the hub's origin, attitude forms.
#include "compiler/spec/initial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/compiler/trial.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kEarth = "environment: {gravity: {mu: 3.98600436e14 m3/s2}}\n";
constexpr const char* kOrbit =
    "orbit: {semi_major_axis: 7000 km, eccentricity: 0.01, inclination: 33.3 deg, raan: 48.2 deg, "
    "argument_of_periapsis: 347.8 deg, true_anomaly: 85.3 deg}";
constexpr const char* kPanels = R"(panels:
  - {name: p, mass: 50, length: 2.4, inertia: [30, 20, 12], stiffness: 150, damping: 8, angle: 12 deg,
     hinge: {position: [0.8, 0, 0], axis: [0, -1, 0], outboard: [1, 0, 0]}}
  - {name: m, mass: 50, length: 2.4, inertia: [30, 20, 12], stiffness: 150, damping: 8, angle: 12 deg,
     hinge: {position: [-0.8, 0, 0], axis: [0, 1, 0], outboard: [-1, 0, 0]}}
)";

/// Relative to the size of the published vector; the digits end at the last place of a double.
void expect_published(const Vector3d& value, const Vector3d& published) {
  EXPECT_LT((value - published).norm(), 1.0e-15 * published.norm()) << value.transpose();
}

Quaterniond attitude_of(const std::string& form) {
  const Trial trial(brick_with("initial: {attitude: {" + form + "}}\n"));
  EXPECT_THAT(trial.faults(), IsEmpty()) << form;
  return trial.model ? trial.model->initial.q_BN : Quaterniond(0.0, 0.0, 0.0, 0.0);
}

TEST(Orbit, GivesThePublishedPositionAndVelocity) {
  const Trial trial(brick_with(kEarth + ("initial: {" + std::string(kOrbit) + "}\n")));
  ASSERT_TRUE(trial.model);
  expect_published(trial.model->initial.r_BN_N,
                   {-2814237.0832776525, 5243396.7192967609, 3673809.4481125535});
  expect_published(trial.model->initial.v_BN_N,
                   {-6214.9223200117558, -4107.6201953659565, 1244.9223786004761});
}

TEST(Orbit, MustBeBoundAndHaveSomethingToOrbit) {
  const Trial open(brick_with(std::string(kEarth) +
                              "initial:\n  orbit: {semi_major_axis: 7000 km, eccentricity: 1, "
                              "inclination: 0, raan: 0, argument_of_periapsis: 0, true_anomaly: 0}"
                              "\n"));
  EXPECT_THAT(open.faults(), ElementsAre(HasSubstr("10:51 SC3302 the orbit is not bound")));
  const Trial nowhere(brick_with("initial: {" + std::string(kOrbit) + "}\n"));
  EXPECT_THAT(nowhere.codes(), ElementsAre(Code::kNeedsGravity));
  EXPECT_EQ(nowhere.diagnostics.all().at(0).span.line, 8);
}

TEST(Orbit, ExcludesPositionAndVelocity) {
  const Trial trial(
      brick_with(kEarth + ("initial: {velocity: [1, 0, 0], " + std::string(kOrbit) + "}\n")));
  EXPECT_THAT(trial.codes(), ElementsAre(Code::kExclusiveKeys));
}

TEST(Initial, PlacesTheHubSoThatTheSystemCentreIsWhereItWasNamed) {
  const Trial trial(brick_with(std::string(kPanels) + "initial: {rate: [0.01, -0.02, 0.015]}\n"));
  ASSERT_TRUE(trial.model);
  const double c = 0.03564200414018731;  // published height of the system centre above B
  const VehicleState& state = trial.model->initial;
  EXPECT_LT((state.r_BN_N - Vector3d(0.0, 0.0, -c)).norm(), 1.0e-15);
  EXPECT_LT((state.v_BN_N - Vector3d(0.02 * c, 0.01 * c, 0.0)).norm(), 1.0e-17);
}

TEST(Initial, CountsTheMotionOfThePanelsInTheVelocityOfTheCentre) {
  const Trial trial(
      brick_with("panels:\n  - {name: p, mass: 600, length: 2, inertia: [30, 20, 12], rate: 0.3,\n"
                 "     hinge: {position: [0, 0, 0], axis: [0, -1, 0], outboard: [1, 0, 0]}}\n"));
  ASSERT_TRUE(trial.model);
  // Half the mass moves at 0.3 rad/s x 1 m along +z, so B moves at half of that along -z.
  EXPECT_LT((trial.model->initial.v_BN_N - Vector3d(0.0, 0.0, -0.15)).norm(), 1.0e-16);
}

TEST(Initial, LeavesTheHubWhereItWasNamedOnRequest) {
  const Trial trial(
      brick_with(std::string(kPanels) + "initial: {point: hub, position: [1, 2, 3]}\n"));
  ASSERT_TRUE(trial.model);
  EXPECT_EQ(trial.model->initial.r_BN_N, Vector3d(1.0, 2.0, 3.0));
}

TEST(Initial, DoesNotStartInsideTheAttractingBodysCentre) {
  const Trial trial(brick_with(std::string(kEarth) + "initial: {velocity: [1, 0, 0]}\n"));
  EXPECT_THAT(trial.codes(), ElementsAre(Code::kAtAttractingCenter));
}

TEST(Attitude, IsTheSameInEveryForm) {
  // A turn by 120 degrees about (1, 1, 1): x of B points along y of N, y along z, z along x.
  const Quaterniond turn(0.5, 0.5, 0.5, 0.5);
  for (const char* form : {"quaternion: [-0.5, -0.5, -0.5, -0.5]",
                           "mrp: [0.33333333333333333, 0.33333333333333333, 0.33333333333333333]",
                           "mrp: [-1, -1, -1]", "dcm_BN: [[0, 1, 0], [0, 0, 1], [1, 0, 0]]",
                           "euler: {sequence: zyx, angles: [90 deg, 0 deg, 90 deg]}",
                           "euler: {sequence: zyz, angles: {value: [0, 90, 90], unit: deg}}",
                           "align: [{axis: x, to: [0, 1, 0]}, {axis: -y, to: [0, 0, -3]}]"}) {
    EXPECT_LT((attitude_of(form).coeffs() - turn.coeffs()).norm(), 1.0e-15) << form;
  }
}

TEST(Attitude, AlignsTheFirstAxisExactlyAndTheSecondAsNearAsItCanBe) {
  const Quaterniond q = attitude_of("align: [{axis: z, to: [0, 0, 1]}, {axis: x, to: [1, 0, 5]}]");
  EXPECT_LT((q.coeffs() - Quaterniond::Identity().coeffs()).norm(), 1.0e-15);
}

TEST(Attitude, FollowsTheDirectionsOfTheOrbit) {
  const Trial trial(brick_with(kEarth + ("initial: {" + std::string(kOrbit) +
                                         ", attitude: {align: [{axis: z, to: velocity}, {axis: y, "
                                         "to: orbit_normal}]}}\n")));
  ASSERT_TRUE(trial.model);
  const VehicleState& state = trial.model->initial;
  const Vector3d h = state.r_BN_N.cross(state.v_BN_N).normalized();
  EXPECT_LT((state.q_BN * Vector3d::UnitZ() - state.v_BN_N.normalized()).norm(), 1.0e-15);
  EXPECT_LT((state.q_BN * Vector3d::UnitY() - h).norm(), 1.0e-15);
}

TEST(Attitude, RefusesWhatIsNoRotation) {
  const auto codes = [](const std::string& form) {
    return Trial(brick_with("initial: {attitude: {" + form + "}}\n")).codes();
  };
  EXPECT_THAT(codes("quaternion: [1, 0, 0, 0.0015]"), ElementsAre(Code::kNotUnitQuaternion));
  EXPECT_THAT(codes("quaternion: [1.0000009, 0, 0, 0]"), IsEmpty());
  EXPECT_THAT(codes("dcm_BN: [[1, 2.0e-9, 0], [0, 1, 0], [0, 0, 1]]"),
              ElementsAre(Code::kNotARotation));
  EXPECT_THAT(codes("dcm_BN: [[1, 5.0e-10, 0], [0, 1, 0], [0, 0, 1]]"), IsEmpty());
  EXPECT_THAT(codes("dcm_BN: [[1, 0, 0], [0, 1, 0], [0, 0, -1]]"),
              ElementsAre(Code::kNotARotation));
  EXPECT_THAT(codes("euler: {sequence: zzx, angles: [0, 0, 0]}"), ElementsAre(Code::kUnknownWord));
}

TEST(Attitude, IsWrittenInExactlyOneForm) {
  EXPECT_THAT(Trial(brick_with("initial: {attitude: {}}\n")).faults().size(), 1u);
  const Trial two(brick_with("initial: {attitude: {mrp: [0, 0, 0], quaternion: [1, 0, 0, 0]}}\n"));
  EXPECT_THAT(two.codes(), ElementsAre(Code::kExclusiveKeys));
}

TEST(Attitude, RefusesAlignmentsThatLeaveItOpen) {
  const auto codes = [](const std::string& entries, const std::string& more = "") {
    return Trial(brick_with(more + "attitude: {align: [" + entries + "]}}\n")).codes();
  };
  const std::string still = "initial: {";
  EXPECT_THAT(codes("{axis: x, to: [1, 0, 0]}, {axis: -x, to: [0, 1, 0]}", still),
              ElementsAre(Code::kAlignImpossible));
  EXPECT_THAT(codes("{axis: x, to: [1, 0, 0]}, {axis: y, to: [-2, 0, 0]}", still),
              ElementsAre(Code::kAlignImpossible));
  EXPECT_THAT(codes("{axis: x, to: velocity}, {axis: y, to: [1, 0, 0]}", still),
              ElementsAre(Code::kNeedsGravity));
  const std::string falling = std::string(kEarth) + "initial: {position: [7.0e6, 0, 0], ";
  EXPECT_THAT(codes("{axis: x, to: radial}, {axis: y, to: velocity}", falling),
              ElementsAre(Code::kAlignImpossible));
}

}  // namespace
}  // namespace twincraft
