// Slosh particles and pendulums: where they are, what they are made of, and what is refused.
#include "compiler/components/slosh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "compiler/analysis/configuration.h"
#include "tests/compiler/trial.h"

namespace twincraft {
namespace {

using testing::ElementsAre;

constexpr const char* kTank =
    "tanks:\n  - {name: main, position: [0, 0, -0.8], shape: {sphere: {radius: 0.75}}, "
    "propellant: 1500}\n";

std::string bob(const std::string& more) {
  return "  - {name: bob, type: pendulum, tank: main, mass: 500, length: 0.3, rest: [0, 0, -1], "
         "reference: [1, 0, 0]" +
         more + "}\n";
}

std::string blob(const std::string& more) {
  return "  - {name: blob, type: particle, mass: 25, axis: [0, 2, 0]" + more + "}\n";
}

TEST(Particle, SlidesFromItsTanksCentreByDefault) {
  const Trial in_tank(brick_with(std::string(kTank) + "slosh:\n" +
                                 blob(", tank: main, displacement: 2 cm, rate: -1 cm/s")));
  ASSERT_TRUE(in_tank.model) << testing::PrintToString(in_tank.faults());
  const Link& link = in_tank.model->assembly.links.at(1);
  EXPECT_EQ(link.joint.kind, JointKind::kSlide);
  EXPECT_EQ(link.joint.r_HP_P, Vector3d(0.0, 0.0, -0.8));
  EXPECT_EQ(link.joint.axis_L, Vector3d::UnitY());
  EXPECT_EQ(link.elements.at(0).tank, 0);
  EXPECT_EQ(link.elements.at(0).I_PntE_L, Matrix3d::Zero());
  EXPECT_EQ(in_tank.model->initial.joint_position, std::vector<double>{0.02});
  EXPECT_EQ(in_tank.model->initial.joint_rate, std::vector<double>{-0.01});
  const Trial alone(brick_with("slosh:\n" + blob("")));
  ASSERT_TRUE(alone.model);
  EXPECT_EQ(alone.model->assembly.links.at(1).joint.r_HP_P, Vector3d::Zero());
  EXPECT_EQ(alone.model->assembly.links.at(1).elements.at(0).tank, -1);
}

TEST(Pendulum, HangsWhereItsAnglesSay) {
  const double phi = 0.4, theta = -0.7, L = 0.3;
  const Trial trial(brick_with(std::string(kTank) + "slosh:\n" +
                               bob(", angles: [0.4, -0.7], rates: [1, 2], damping: 5")));
  ASSERT_TRUE(trial.model) << testing::PrintToString(trial.faults());
  const Model& model = *trial.model;
  ASSERT_EQ(model.coordinates.size(), 2u);
  EXPECT_EQ(model.coordinates[0].name, "bob.phi");
  EXPECT_EQ(model.coordinates[1].name, "bob.theta");
  const auto links =
      configuration(model.assembly, model.initial.joint_position, model.initial.joint_rate);
  const Vector3d l = links[2].r_LB_B + links[2].dcm_BL * Vector3d(L, 0.0, 0.0);
  const Vector3d p1(0.0, 0.0, -1.0), p2(1.0, 0.0, 0.0), p3(0.0, -1.0, 0.0);
  const Vector3d expected = L * (std::cos(phi) * std::cos(theta) * p1 +
                                 std::sin(phi) * std::cos(theta) * p2 - std::sin(theta) * p3);
  EXPECT_LT((l - Vector3d(0.0, 0.0, -0.8) - expected).norm(), 1e-15);
  const Joint& first = model.assembly.links[1].joint;
  EXPECT_EQ(first.damped_by_cosine_of, 2);
  EXPECT_DOUBLE_EQ(first.damping, 5.0 * L * L);
  EXPECT_TRUE(model.assembly.links[1].elements.empty());
}

TEST(Pendulum, IsOneBodyWithTwoJointsInTheTree) {
  const Trial trial(brick_with(std::string(kTank) + "slosh:\n" + bob(", inertia: 2")));
  ASSERT_TRUE(trial.model);
  const TreeBody& body = trial.model->tree.bodies.back();
  EXPECT_EQ(body.name, "bob");
  ASSERT_EQ(body.joints.size(), 2u);
  EXPECT_EQ(body.joints[0].name, "bob.phi");
  EXPECT_EQ(body.joints[1].name, "bob.theta");
  EXPECT_EQ(body.inertial.I_PntC_L, 2.0 * Matrix3d::Identity());
  EXPECT_EQ(body.tank, 0);
}

TEST(TokenInertia, IsInTheTreeAlone) {
  const Trial trial(brick_with(std::string(kTank) + "slosh:\n" + bob("") + blob(", tank: main") +
                               "engines: {mujoco: {bob_inertia: 1.0e-4, particle_inertia: "
                               "1.0e-6}}\n"));
  ASSERT_TRUE(trial.model) << testing::PrintToString(trial.faults());
  const auto& bodies = trial.model->tree.bodies;
  EXPECT_EQ(bodies.at(2).inertial.I_PntC_L, 1.0e-4 * Matrix3d::Identity());
  EXPECT_EQ(bodies.at(3).inertial.I_PntC_L, 1.0e-6 * Matrix3d::Identity());
  for (std::size_t i = 1; i < trial.model->assembly.links.size(); ++i) {
    for (const MassElement& element : trial.model->assembly.links[i].elements) {
      EXPECT_EQ(element.I_PntE_L, Matrix3d::Zero()) << element.name;
    }
  }
}

TEST(Slosh, RefusesWhatCannotSwing) {
  const auto codes = [](const std::string& slosh) {
    return Trial(brick_with(kTank + ("slosh:\n" + slosh))).codes();
  };
  EXPECT_THAT(codes(bob(", angles: [0, 1.5707963]")), ElementsAre(Code::kPendulumSingular));
  EXPECT_THAT(codes(blob(", tank: mian")), ElementsAre(Code::kUnknownComponent));
  EXPECT_THAT(codes(blob(", tank: main, mount: main")),
              ElementsAre(Code::kMountNotAllowed, Code::kMissingKey));
  EXPECT_THAT(codes(bob(", angles: [0, 0, 0]")), ElementsAre(Code::kTooMany));
  EXPECT_THAT(Trial(brick_with("slosh:\n  - {name: bob, type: pendulum, mass: 500, length: 0.3, "
                               "rest: [0, 0, -1], reference: [1, 0, 1.0e-6]}\n"))
                  .codes(),
              ElementsAre(Code::kNotPerpendicular));
}

TEST(StepRule, FollowsSlosh) {
  const auto step = [](const std::string& of) {
    const Trial trial(
        "format: spacecraft/1\nname: tanker\nhub: {mass: 1500, inertia: [400, 380, "
        "360]}\nsimulation: {step: {per_period: 150, of: " +
        of + "}, duration: 900}\n" + kTank + "slosh:\n" + bob(", damping: 1") +
        blob(", tank: main, stiffness: 4") +
        "thrusters:\n  - {name: engine, direction: [0, 0, 1], thrust: 445, isp: 234, "
        "tank: main}\n");
    EXPECT_TRUE(trial.model) << testing::PrintToString(trial.faults());
    return trial.model->simulation.step;
  };
  constexpr double kTurn = 6.283185307179586;
  EXPECT_DOUBLE_EQ(step("bob"), kTurn * std::sqrt(0.3 * 3000.0 / 445.0) / 150.0);
  EXPECT_DOUBLE_EQ(step("blob"), kTurn * std::sqrt(25.0 / 4.0) / 150.0);
}

}  // namespace
}  // namespace twincraft
