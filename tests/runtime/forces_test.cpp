// Claims about gravity and loads: exact differences, the laws' relations, and no work in vain.
#include "runtime/forces/forces.h"

#include <gtest/gtest.h>

#include "runtime/forces/field.h"
#include "tests/support/dense_oracle.h"

namespace twincraft {
namespace {

constexpr double kMu = 3.98600436e14;

Vector3d difference(const Vector3d& r, const Vector3d& x) {
  return portable::eigen(
      portable::Field<double>(kMu, portable::vec(r), false).difference(portable::vec(x)));
}

TEST(GravityDifference, AgreesWithSubtractionWhereThatIsAccurate) {
  const Vector3d r(7.0e6, 1.0e6, -2.0e6), x(5.0e5, -3.0e5, 2.0e5);
  const Vector3d subtracted = point_gravity(kMu, r + x) - point_gravity(kMu, r);
  EXPECT_LT((difference(r, x) - subtracted).norm(), 1e-14 * point_gravity(kMu, r).norm());
}

TEST(GravityDifference, KeepsItsDigitsForAMetre) {
  // Along the radius: mu/r^2 (1 - (1 + e)^-2) = mu/r^2 (2e - 3e^2 + 4e^3 ...).
  const double r = 7.0e6, x = 1.0, e = x / r;
  const double series = kMu / (r * r) * (2.0 * e - 3.0 * e * e + 4.0 * e * e * e);
  EXPECT_NEAR(difference({r, 0, 0}, {x, 0, 0}).x(), series, 4e-15 * series);
}

struct Scene {
  Model model;
  std::vector<std::vector<MassElement>> elements;
  std::vector<LinkPose> poses;
  Vector3d r_BN{6.0e6, -3.0e6, 2.0e6};
};

Scene random_scene() {
  std::mt19937_64 random(9);
  Scene scene;
  scene.model.gravity.mu = kMu;
  for (int i = 0; i < 4; ++i) {
    scene.elements.push_back({{"e", 10.0 + i, test::random_vector(random, 2.0),
                               Matrix3d(Vector3d(3.0, 4.0, 5.0).asDiagonal())}});
    const Vector3d r = test::random_vector(random, 1.0);
    scene.poses.push_back({Quaterniond(1.0, r.x(), r.y(), r.z()).normalized().toRotationMatrix(),
                           i == 0 ? Vector3d::Zero() : test::random_vector(random, 3.0)});
  }
  return scene;
}

/// Total force and torque about C, with the common fall put back as a uniform field.
std::pair<Vector3d, Vector3d> totals(const Scene& s, GravityLaw law, FieldFrame frame) {
  const ForceModel forces(s.model, law, s.elements, frame);
  std::vector<Wrench> wrenches(s.poses.size());
  forces.apply(s.r_BN, s.poses, {}, wrenches);
  const Vector3d common = forces.fall(s.r_BN, Matrix3d::Identity(), s.poses);
  double mass = 0.0;
  Vector3d moment = Vector3d::Zero();
  for (std::size_t i = 0; i < s.poses.size(); ++i) {
    mass += s.elements[i][0].mass;
    moment +=
        s.elements[i][0].mass * (s.poses[i].r_LB_W + s.poses[i].dcm_WL * s.elements[i][0].r_EL_L);
  }
  Vector3d force = mass * common, torque = Vector3d::Zero();
  for (const Wrench& w : wrenches) {
    force += w.force_W;
    torque += w.torque_PntB_W - (moment / mass).cross(w.force_W);
  }
  return {force, torque};
}

TEST(ForceModel, PullsTheSameInTheFallingAndTheInertialFrame) {
  const Scene scene = random_scene();
  for (const GravityLaw law :
       {GravityLaw::kSystemCom, GravityLaw::kBodyCom, GravityLaw::kBodyGradient}) {
    const auto [f1, t1] = totals(scene, law, FieldFrame::kFalling);
    const auto [f2, t2] = totals(scene, law, FieldFrame::kInertial);
    EXPECT_LT((f1 - f2).norm(), 1e-14 * f2.norm());
    EXPECT_LT((t1 - t2).norm(), 1e-13 * f2.norm());
  }
}

TEST(ForceModel, LeavesNoTorqueFromOneForceAtTheSystemCentre) {
  EXPECT_LT(totals(random_scene(), GravityLaw::kSystemCom, FieldFrame::kFalling).second.norm(),
            1e-12);
}

TEST(ForceModel, GivesTheGradientOfOneRigidBodyInClosedForm) {
  Scene scene = random_scene();
  scene.elements.resize(1);
  scene.poses.resize(1);
  scene.elements[0][0].r_EL_L.setZero();
  const Vector3d torque = totals(scene, GravityLaw::kBodyGradient, FieldFrame::kFalling).second;
  const Vector3d rhat = scene.r_BN.normalized();
  const Matrix3d I =
      scene.poses[0].dcm_WL * scene.elements[0][0].I_PntE_L * scene.poses[0].dcm_WL.transpose();
  const Vector3d printed = 3.0 * kMu / std::pow(scene.r_BN.norm(), 3) * rhat.cross(I * rhat);
  EXPECT_LT((torque - printed).norm(), 1e-15 * 3.0 * kMu / std::pow(scene.r_BN.norm(), 3) * 5.0);
}

TEST(ForceModel, ActsWithALoadOnlyWhileItLasts) {
  Scene scene = random_scene();
  Load load{"push", 1, {}, {}, Vector3d::Zero()};
  load.torque_L[0] = Schedule::constant(2.0).during({{10.0, 20.0}});
  scene.model.loads = {load};
  ForceModel forces(scene.model, GravityLaw::kNone, scene.elements, FieldFrame::kFalling);
  EXPECT_TRUE(forces.is_idle());
  forces.hold(inputs_at(scene.model, 10.0));
  EXPECT_FALSE(forces.is_idle());
  std::vector<Wrench> wrenches(scene.poses.size());
  forces.apply(scene.r_BN, scene.poses, {}, wrenches);
  EXPECT_LT((wrenches[1].torque_PntB_W - scene.poses[1].dcm_WL.col(0) * 2.0).norm(), 1e-15);
  forces.hold(inputs_at(scene.model, 20.0));
  EXPECT_TRUE(forces.is_idle());
}

// What is held for all evaluations must not depend on where links are.
TEST(ForceModel, ActsOnTheHubAloneOnlyWhereNoOtherLinkMatters) {
  Scene scene = random_scene();
  const auto on_hub_alone = [&scene](int link, std::optional<Vector3d> place, GravityLaw law,
                                     FieldFrame frame = FieldFrame::kFalling) {
    Load load{"push", link, {}, {}, place};
    load.force_L[1] = Schedule::constant(7.0);
    scene.model.loads = {load};
    return ForceModel(scene.model, law, scene.elements, frame).acts_on_hub_alone();
  };
  const Vector3d place(1.0, 2.0, 3.0);
  EXPECT_TRUE(on_hub_alone(0, place, GravityLaw::kNone));
  EXPECT_FALSE(on_hub_alone(1, place, GravityLaw::kNone));
  EXPECT_FALSE(on_hub_alone(0, std::nullopt, GravityLaw::kNone));
  for (const GravityLaw law :
       {GravityLaw::kBodyCom, GravityLaw::kBodyGradient, GravityLaw::kSystemCom})
    EXPECT_FALSE(on_hub_alone(0, place, law));
  for (auto& link : scene.elements) link.clear();
  scene.elements[0] = {{"hub", 10.0, Vector3d::Zero(), Matrix3d::Identity()}};
  EXPECT_TRUE(on_hub_alone(0, place, GravityLaw::kBodyCom));
  EXPECT_FALSE(on_hub_alone(0, place, GravityLaw::kBodyCom, FieldFrame::kInertial));
}

TEST(ForceModel, PutsALoadAtTheSystemCentreWithoutTurningTheVehicle) {
  Scene scene = random_scene();
  Load load{"push", 0, {}, {}, std::nullopt};
  load.force_L[1] = Schedule::constant(7.0);
  scene.model.loads = {load};
  const auto [force, torque] = totals(scene, GravityLaw::kNone, FieldFrame::kFalling);
  EXPECT_NEAR(force.norm(), 7.0, 1e-14);
  EXPECT_LT(torque.norm(), 1e-13);
}

}  // namespace
}  // namespace twincraft
