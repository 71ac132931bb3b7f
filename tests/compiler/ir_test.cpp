// Claims about the IR's own arithmetic: masses, schedules, numbers; and about its names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <charconv>
#include <random>

#include "compiler/ir/body_tree.h"
#include "compiler/ir/mass.h"
#include "compiler/ir/number.h"
#include "compiler/ir/propellant.h"
#include "compiler/ir/rotation.h"
#include "compiler/ir/schedule.h"
#include "compiler/ir/signals.h"

namespace twincraft {
namespace {

Matrix3d about_origin(const MassProperties& p) {
  return parallel_axis(p.I_PntC_L, p.mass, p.r_CL_L);
}

TEST(MassProperties, AddAboutAnyCommonPoint) {
  const MassProperties a{3.0, {1.0, 2.0, -0.5}, Vector3d(2.0, 3.0, 4.0).asDiagonal()};
  const MassProperties b{5.0, {-0.3, 0.7, 1.1}, Vector3d(6.0, 5.0, 4.5).asDiagonal()};
  const MassProperties sum = a + b;
  EXPECT_DOUBLE_EQ(sum.mass, 8.0);
  EXPECT_LT((about_origin(sum) - about_origin(a) - about_origin(b)).norm(), 1e-13);
  EXPECT_LT((sum.mass * sum.r_CL_L - a.mass * a.r_CL_L - b.mass * b.r_CL_L).norm(), 1e-14);
}

TEST(MassProperties, TakeOutAgainWhatWasPutIn) {
  const MassProperties hub{600.0, {0.1, 0.0, 0.0}, Vector3d(400.0, 380.0, 360.0).asDiagonal()};
  const MassProperties token{1e-6, {0.5, 0.2, 0.0}, Matrix3d::Zero()};
  MassProperties minus = token;
  minus.mass = -token.mass;
  const MassProperties back = (hub + minus) + token;
  EXPECT_NEAR(back.mass, hub.mass, 1e-12);
  EXPECT_LT((back.r_CL_L - hub.r_CL_L).norm(), 1e-15);
  EXPECT_LT((back.I_PntC_L - hub.I_PntC_L).norm(), 1e-12);
}

TEST(MassProperties, AMasslessTensorMovesNothing) {
  const MassProperties hub{600.0, {0.1, 0.2, 0.3}, Matrix3d::Identity()};
  const MassProperties wheel{0.0, {9.0, 9.0, 9.0}, 2.0 * Matrix3d::Identity()};
  EXPECT_EQ((hub + wheel).r_CL_L, hub.r_CL_L);
  EXPECT_EQ((wheel + hub).r_CL_L, hub.r_CL_L);
  EXPECT_EQ((hub + wheel).I_PntC_L, 3.0 * Matrix3d::Identity());
}

TEST(PrincipalInertia, KeepsADiagonalTensorAsWritten) {
  const PrincipalInertia p = principal_inertia(Vector3d(600.0, 900.0, 800.0).asDiagonal());
  EXPECT_EQ(p.moments, Vector3d(600.0, 900.0, 800.0));
  EXPECT_EQ(p.axes.coeffs(), Quaterniond::Identity().coeffs());
}

TEST(PrincipalInertia, RebuildsRandomTensorsToRounding) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 300; ++i) {
    const Matrix3d half = Matrix3d::NullaryExpr([&] { return uniform(random); });
    const Matrix3d I = half * half.transpose() + 0.1 * Matrix3d::Identity();
    const PrincipalInertia p = principal_inertia(I);
    const Matrix3d R = p.axes.toRotationMatrix();
    EXPECT_NEAR(R.determinant(), 1.0, 1e-14);
    EXPECT_LT((R * p.moments.asDiagonal() * R.transpose() - I).norm(), 1e-14 * I.norm());
  }
}

Matrix3d tensor_of(const PrincipalInertia& p) {
  const Matrix3d axes = p.axes.toRotationMatrix();
  return axes * p.moments.asDiagonal() * axes.transpose();
}

TEST(ToldInertia, KeepsAxesThatAreExactlyTheBodysOrClearlyNot) {
  const Matrix3d I = Vector3d(600.0, 900.0, 800.0).asDiagonal();
  for (const Vector3d& place : {Vector3d(0.0, 0.0, 0.0), Vector3d(0.1, 1e-7, 0.0)}) {
    const PrincipalInertia told = told_inertia({1.0, place, I});
    EXPECT_EQ(told.moments, Vector3d(600.0, 900.0, 800.0));
    EXPECT_EQ(told.axes.coeffs(), Quaterniond::Identity().coeffs());
  }
  const Matrix3d turn = Eigen::AngleAxisd(0.1, Vector3d::UnitX()).toRotationMatrix();
  const MassProperties turned{1.0, Vector3d(1e-7, 0.0, 0.0), turn * I * turn.transpose()};
  EXPECT_EQ(told_inertia(turned).axes.coeffs(), principal_inertia(turned.I_PntC_L).axes.coeffs());
}

TEST(ToldInertia, NamesAxesAnewThatMujocoWouldTakeForTheBodys) {
  const Matrix3d I = Vector3d(600.0, 900.0, 800.0).asDiagonal();
  const PrincipalInertia moved = told_inertia({1.0, Vector3d(0.0, -9e-7, 0.0), I});
  EXPECT_EQ(moved.moments, Vector3d(900.0, 800.0, 600.0));
  EXPECT_EQ(moved.axes.coeffs(), Quaterniond(0.5, 0.5, 0.5, 0.5).coeffs());
  EXPECT_EQ(tensor_of(moved), I);

  Matrix3d near;  // [kg m^2] its principal axes are 7e-7 rad off
  near << 350.0, 1e-5, 0.0, 1e-5, 380.0, -2e-5, 0.0, -2e-5, 410.0;
  ASSERT_LT(principal_inertia(near).axes.vec().norm(), 1e-6);
  for (const Vector3d& place : {Vector3d(0.0, 0.0, 0.0), Vector3d(0.1, 0.0, 0.0)}) {
    const PrincipalInertia turned = told_inertia({1.0, place, near});
    EXPECT_GT(turned.axes.vec().cwiseAbs().minCoeff(), 0.4);
    EXPECT_LT((tensor_of(turned) - near).norm(), 1e-12);
  }
}

TEST(ShortestRotation, TakesOneDirectionToAnyOther) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  const Vector3d from(0.0, 0.0, 2.0);
  std::vector<Vector3d> directions{from, -from, {3.0, 0.0, 0.0}, {1.0e-13, 0.0, -1.0}};
  for (int i = 0; i < 100; ++i)
    directions.emplace_back(normal(random), normal(random), normal(random));
  for (const Vector3d& to : directions) {
    const Quaterniond rotation = shortest_rotation(from, to);
    EXPECT_NEAR(rotation.norm(), 1.0, 1.0e-12);
    // Its axis is across both; within 1e-12 of a half turn any such axis will do.
    EXPECT_LT(std::abs(rotation.vec().dot(from)), 1.0e-12) << to.transpose();
    EXPECT_LT((rotation * from.normalized() - to.normalized()).norm(), 1.0e-12) << to.transpose();
  }
}

TEST(Schedule, IsPiecewiseConstantAndRightContinuous) {
  const Schedule s{{{1.0, 10.0}, {2.0, 20.0}}};
  EXPECT_EQ(s.at(0.999), 0.0);
  EXPECT_EQ(s.at(1.0), 10.0);
  EXPECT_EQ(s.at(1.999), 10.0);
  EXPECT_EQ(s.at(2.0), 20.0);
  EXPECT_EQ(s.at(1e9), 20.0);
  EXPECT_EQ(Schedule::constant(3.0).at(-1e300), 3.0);
}

TEST(Schedule, OpensAndClosesWithItsIntervals) {
  const Schedule s = Schedule{{{0.0, 1.0}, {5.0, 2.0}}}.during({{1.0, 3.0}, {3.0, 6.0}});
  EXPECT_EQ(s.at(0.5), 0.0);
  EXPECT_EQ(s.at(1.0), 1.0);
  EXPECT_EQ(s.at(3.0), 1.0);
  EXPECT_EQ(s.at(5.0), 2.0);
  EXPECT_EQ(s.at(6.0), 0.0);
  EXPECT_EQ(event_times({&s}, 100.0), (std::vector<double>{1.0, 3.0, 5.0, 6.0}));
  EXPECT_EQ(event_times({&s}, 4.0), (std::vector<double>{1.0, 3.0}));
}

TEST(Schedule, AddsAtEveryTimeOfEither) {
  const Schedule a{{{1.0, 10.0}, {3.0, 0.0}}}, b = Schedule::constant(2.0);
  const Schedule sum = a + b.scaled(2.0);
  for (const double t : {0.0, 1.0, 2.0, 3.0, 4.0}) EXPECT_EQ(sum.at(t), a.at(t) + 4.0) << t;
  EXPECT_EQ(event_times({&sum}, 100.0), (std::vector<double>{1.0, 3.0}));
}

TEST(Tank, RunsDownByTheIntegralOfItsFlow) {
  const Tank tank{"main", 100.0, {{{1.0, 10.0}, {3.0, 0.0}, {5.0, 2.0}}}};
  const std::pair<double, double> expected[] = {{-1.0, 100.0}, {0.5, 100.0}, {2.0, 90.0},
                                                {3.0, 80.0},   {4.0, 80.0},  {6.0, 78.0}};
  for (const auto& [time, content] : expected) {
    EXPECT_EQ(tank.content_at(time), content) << time;
    EXPECT_EQ(tank.share(time), content / 100.0) << time;
  }
  const Tank always{"main", 100.0, Schedule::constant(10.0)};
  EXPECT_EQ(always.content_at(2.0), 80.0);
}

TEST(Number, IsTheShortestTextThatReadsBackEqual) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(1e-6), "1e-06");
  EXPECT_EQ(shortest(7e6), "7e+06");
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1e9, 1e9);
  for (int i = 0; i < 1000; ++i) {
    const double value = uniform(random);
    const std::string text = shortest(value);
    double back = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), back);
    EXPECT_EQ(back, value);
  }
}

/// A wheel, a slide that the assembly has first, a hinge, a panel; a thruster and a load.
Model named_model() {
  using Kind = Coordinate::Kind;
  Model model;
  model.assembly.links.resize(4);
  model.assembly.rotors.resize(1);
  model.coordinates = {{"rw", Kind::kWheel, 0},
                       {"wing.1", Kind::kPanel, 3},
                       {"arm", Kind::kBodyAngle, 2},
                       {"rail", Kind::kBodyDisplacement, 1}};
  model.loads.resize(2);
  model.loads[0].name = "engine";
  model.loads[0].thruster = Thruster{};
  model.loads[1].name = "push";
  return model;
}

std::vector<std::string> names_and_units(const auto& signals) {
  std::vector<std::string> texts;
  for (const Signal& signal : signals) texts.push_back(signal.name + " [" + signal.unit + "]");
  return texts;
}

TEST(Signals, NameOutputsInTheOrderOfTheSpec) {
  EXPECT_THAT(
      names_and_units(outputs_of(named_model())),
      testing::ElementsAre("r_BN_N [m]", "v_BN_N [m/s]", "q_BN [1]", "omega_BN_B [rad/s]",
                           "r_CN_N [m]", "v_CN_N [m/s]", "rw.rate [rad/s]", "wing.1.position [rad]",
                           "wing.1.rate [rad/s]", "arm.position [rad]", "arm.rate [rad/s]",
                           "rail.position [m]", "rail.rate [m/s]", "mass [kg]"));
}

TEST(Signals, NameStatesInTheOrderOfTheAssembly) {
  Model model = named_model();
  const std::vector<std::string> names = component_names(states_of(model, AttitudeChart::kMrp));
  EXPECT_THAT(
      std::vector(names.begin() + 6, names.end()),
      testing::ElementsAre("sigma_BN.1", "sigma_BN.2", "sigma_BN.3", "omega_BN_B.x", "omega_BN_B.y",
                           "omega_BN_B.z", "rail.position", "arm.position", "wing.1.position",
                           "rail.rate", "arm.rate", "wing.1.rate", "rw.rate"));
  EXPECT_EQ(component_names(states_of(model, AttitudeChart::kQuaternion)).at(6), "q_BN.w");
  model.simulation.translation = true;
  EXPECT_THAT(component_names(states_of(model, AttitudeChart::kMrp)), testing::SizeIs(6));
}

TEST(Signals, NameInputsOfAllThatASpecMayDrive) {
  EXPECT_THAT(names_and_units(inputs_of(named_model())),
              testing::ElementsAre("rw.torque [N m]", "arm.torque [N m]", "rail.force [N]",
                                   "engine.thrust [N]", "push.force [N]", "push.torque [N m]"));
}

TEST(Coordinates, StandInTheirTableInTheOrderOfTheirKinds) {
  for (std::size_t i = 0; i < kCoordinateKinds.size(); ++i)
    EXPECT_EQ(static_cast<std::size_t>(kCoordinateKinds.at(i).kind), i);
}

}  // namespace
}  // namespace twincraft
