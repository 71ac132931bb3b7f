// Bodies: joints of every sort, order, what is mounted on them, and what cannot be one.
#include "compiler/components/body.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compiler/analysis/configuration.h"
#include "tests/compiler/trial.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kHinge = "{type: revolute, axis: [0, 0, 1]}";

/// A list item of `bodies`.
std::string body(const std::string& name, const std::string& joint, const std::string& more = "") {
  return fmt::format("  - {{name: {}, mass: 2, inertia: [0.1, 0.2, 0.2], joint: {}{}}}\n", name,
                     joint, more);
}

std::string bodies(const std::string& items, const std::string& more = "") {
  return brick_with("bodies:\n" + items + more);
}

std::vector<std::string> link_names(const Model& model) {
  std::vector<std::string> names;
  for (const Link& link : model.assembly.links) names.push_back(link.name);
  return names;
}

std::vector<std::string> coordinate_names(const Model& model) {
  std::vector<std::string> names;
  for (const Coordinate& coordinate : model.coordinates) names.push_back(coordinate.name);
  return names;
}

TEST(Body, TurnsOnARevoluteJoint) {
  const Trial trial(bodies(
      body("arm",
           "{type: revolute, axis: [0, 2, 0], position: [0.5, 0, 0], stiffness: 3, damping: 2, "
           "rest: 10 deg, angle: 90 deg, rate: 0.1, torque: [[1 s, 0.5]]}",
           ", orientation: {euler: {sequence: zyx, angles: [90 deg, 0, 0]}}")));
  ASSERT_TRUE(trial.model) << testing::PrintToString(trial.faults());
  const Joint& joint = trial.model->assembly.links.at(1).joint;
  EXPECT_EQ(joint.kind, JointKind::kHinge);
  EXPECT_EQ(joint.axis_L, Vector3d::UnitY());
  EXPECT_EQ(joint.r_HP_P, Vector3d(0.5, 0.0, 0.0));
  EXPECT_EQ(joint.stiffness, 3.0);
  EXPECT_EQ(joint.damping, 2.0);
  EXPECT_EQ(joint.rest, 10.0 * kDegree);
  EXPECT_EQ(joint.effort.at(0.5), 0.0);
  EXPECT_EQ(joint.effort.at(1.0), 0.5);
  const VehicleState& state = trial.model->initial;
  const LinkMotion link =
      configuration(trial.model->assembly, state.joint_position, state.joint_rate).at(1);
  // First a quarter about z, then one about the body's own y, which lies along -x.
  EXPECT_LT((link.dcm_BL * Vector3d::UnitX() + Vector3d::UnitZ()).norm(), 1.0e-15);
  EXPECT_LT((link.omega_LB_B + 0.1 * Vector3d::UnitX()).norm(), 1.0e-15);
  EXPECT_EQ(trial.model->coordinates.at(0).kind, Coordinate::Kind::kBodyAngle);
}

TEST(Body, SlidesOnAPrismaticJoint) {
  const Trial trial(
      bodies(body("rail",
                  "{type: prismatic, axis: [1, 0, 0], stiffness: 30 N/m, damping: 2 N s/m, rest: "
                  "1 cm, displacement: 20 mm, rate: 1 mm/s, force: 5 N}")));
  ASSERT_TRUE(trial.model) << testing::PrintToString(trial.faults());
  const Joint& joint = trial.model->assembly.links.at(1).joint;
  EXPECT_EQ(joint.kind, JointKind::kSlide);
  EXPECT_EQ(joint.stiffness, 30.0);
  EXPECT_EQ(joint.damping, 2.0);
  EXPECT_EQ(joint.rest, 0.01);
  EXPECT_EQ(joint.effort.at(0.0), 5.0);
  EXPECT_EQ(trial.model->coordinates.at(0).kind, Coordinate::Kind::kBodyDisplacement);
  EXPECT_THAT(trial.model->initial.joint_position, ElementsAre(0.02));
  EXPECT_THAT(trial.model->initial.joint_rate, ElementsAre(0.001));
}

TEST(Body, ThatIsFixedIsPartOfWhatCarriesIt) {
  // A quarter about z, so that the body's x lies along the hub's y.
  const Trial trial(
      bodies(body("mast", "{type: fixed, position: [1, 0, 0]}",
                  ", center_of_mass: [0.5, 0, 0], orientation: {quaternion: [0.70710678118654752, "
                  "0, 0, 0.70710678118654752]}")));
  ASSERT_TRUE(trial.model) << testing::PrintToString(trial.faults());
  EXPECT_THAT(link_names(*trial.model), ElementsAre("hub"));
  EXPECT_THAT(trial.model->coordinates, IsEmpty());
  const MassElement& element = trial.model->assembly.links.at(0).elements.at(1);
  EXPECT_EQ(element.name, "mast");
  EXPECT_LT((element.r_EL_L - Vector3d(1.0, 0.5, 0.0)).norm(), 1.0e-15);
  const Matrix3d turned = Vector3d(0.2, 0.1, 0.2).asDiagonal();
  EXPECT_LT((element.I_PntE_L - turned).norm(), 1.0e-15);
  const TreeBody& welded = trial.model->tree.bodies.at(1);
  EXPECT_THAT(welded.joints, IsEmpty());
  EXPECT_EQ(welded.inertial.mass, 2.0);
  EXPECT_EQ(welded.inertial.r_CL_L, Vector3d(0.5, 0.0, 0.0));
}

TEST(Body, MayBeWrittenBeforeItsParent) {
  const Trial trial(bodies(body("tip", kHinge, ", parent: middle") + body("other", kHinge) +
                           body("middle", kHinge, ", parent: root") + body("root", kHinge)));
  ASSERT_TRUE(trial.model) << testing::PrintToString(trial.faults());
  EXPECT_THAT(link_names(*trial.model), ElementsAre("hub", "other", "root", "middle", "tip"));
  EXPECT_THAT(coordinate_names(*trial.model), ElementsAre("tip", "other", "middle", "root"));
  EXPECT_EQ(trial.model->coordinates.at(0).index, 4);
  EXPECT_EQ(trial.model->assembly.links.at(4).parent, 3);
}

TEST(Body, KeepsTheOrderItIsWrittenInWhereThatIsATree) {
  const Trial trial(bodies(body("a", kHinge) + body("b", kHinge, ", parent: a") +
                           body("c", kHinge, ", parent: a") + body("d", kHinge)));
  ASSERT_TRUE(trial.model);
  EXPECT_THAT(link_names(*trial.model), ElementsAre("hub", "a", "b", "c", "d"));
  EXPECT_EQ(trial.model->assembly.links.at(3).parent, 1);
}

TEST(Body, ReportsItsCoordinateAfterPanels) {
  const Trial trial(bodies(body("arm", kHinge), R"(panels:
  - {name: wing, mount: arm, mass: 50, length: 2, inertia: [3, 2, 2],
     hinge: {position: [1, 0, 0], axis: [0, 1, 0], outboard: [1, 0, 0]}}
wheels:
  - {name: rw, mount: arm, axis: [1, 0, 0], spin_inertia: 0.08, transverse_inertia: 0.04}
)"));
  ASSERT_TRUE(trial.model) << testing::PrintToString(trial.faults());
  EXPECT_THAT(coordinate_names(*trial.model), ElementsAre("rw", "wing.1", "arm"));
  EXPECT_EQ(trial.model->assembly.rotors.at(0).link, 1);
  EXPECT_EQ(trial.model->assembly.links.at(2).parent, 1);
}

/// On a fixed body at [1, 0, 0] whose x lies along the hub's y, and y along minus x.
TEST(Body, ThatIsFixedTurnsWhatIsMountedOnIt) {
  const Trial trial(bodies(body("mast", "{type: fixed, position: [1, 0, 0]}",
                                ", orientation: {euler: {sequence: zyx, angles: [90 deg, 0, 0]}}"),
                           R"(panels:
  - {name: wing, mount: mast, mass: 50, length: 2, inertia: [3, 2, 2],
     hinge: {position: [1, 0, 0], axis: [0, 1, 0], outboard: [1, 0, 0]}}
wheels:
  - {name: rw, mount: mast, position: [0, 2, 0], axis: [1, 0, 0], mass: 3, spin_inertia: 0.08, transverse_inertia: 0.04}
loads:
  - {name: push, mount: mast, force: [[[0, 1], [5, 2]], 0.5, 0], torque: [0, 4, 0], position: [0, 0, 3]}
)"));
  ASSERT_TRUE(trial.model) << testing::PrintToString(trial.faults());
  const Assembly& assembly = trial.model->assembly;
  EXPECT_LT((assembly.rotors.at(0).axis_L - Vector3d::UnitY()).norm(), 1.0e-15);
  EXPECT_LT((assembly.links.at(0).elements.at(2).r_EL_L - Vector3d(-1.0, 0.0, 0.0)).norm(),
            1.0e-15);
  EXPECT_LT((assembly.links.at(1).joint.r_HP_P - Vector3d(1.0, 1.0, 0.0)).norm(), 1.0e-15);
  EXPECT_LT((assembly.links.at(1).joint.dcm_PL0.col(0) - Vector3d::UnitY()).norm(), 1.0e-15);
  const Load& load = trial.model->loads.at(0);
  EXPECT_NEAR(load.force_L[0].at(6.0), -0.5, 1.0e-15);
  EXPECT_NEAR(load.force_L[1].at(4.0), 1.0, 1.0e-15);
  EXPECT_NEAR(load.force_L[1].at(6.0), 2.0, 1.0e-15);
  EXPECT_NEAR(load.torque_L[0].at(0.0), -4.0, 1.0e-15);
  EXPECT_EQ(load.r_FL_L.value(), Vector3d(1.0, 0.0, 3.0));
}

TEST(Body, HasTheKeysOfItsJointAndNoOther) {
  const auto faults = [](const std::string& joint) {
    return Trial(bodies(body("arm", joint))).faults();
  };
  EXPECT_THAT(faults("{type: revolute, axis: [0, 0, 1], displacement: 1}"),
              ElementsAre(HasSubstr("SC2001 unknown key `displacement` in revolute joint of body "
                                    "`arm`")));
  EXPECT_THAT(faults("{type: revolute, axis: [0, 0, 1], force: 1}"),
              ElementsAre(HasSubstr("SC2001 unknown key `force`")));
  EXPECT_THAT(faults("{type: prismatic, axis: [0, 0, 1], angle: 1}"),
              ElementsAre(HasSubstr("SC2001 unknown key `angle`")));
  EXPECT_THAT(faults("{type: prismatic, axis: [0, 0, 1], torque: 1}"),
              ElementsAre(HasSubstr("SC2001 unknown key `torque`")));
  EXPECT_THAT(faults("{type: fixed, axis: [0, 0, 1]}"),
              ElementsAre(HasSubstr("SC2001 unknown key `axis` in fixed joint of body `arm`")));
  EXPECT_THAT(faults("{type: revolute}"),
              ElementsAre(HasSubstr("SC2002 `axis` is missing in revolute joint")));
  EXPECT_THAT(faults("{type: prismatic, axis: [0, 0, 1], rest: 3 deg}"),
              ElementsAre(HasSubstr("SC2007")));
  EXPECT_THAT(faults("{type: prismatic, axis: [0, 0, 1], stiffness: -1}"),
              ElementsAre(HasSubstr("SC2008")));
}

TEST(Body, HasAJointOfSomeType) {
  const Trial none(bodies(body("arm", "{axis: [0, 0, 1]}")));
  EXPECT_THAT(none.faults(), ElementsAre(HasSubstr("SC2002 `type` is missing in `joint` of body "
                                                   "`arm` (add `type`: `revolute`, `prismatic` or "
                                                   "`fixed`)")));
  const Trial other(bodies(body("arm", "{type: revolve}")));
  EXPECT_THAT(other.faults(), ElementsAre(HasSubstr("did you mean `revolute`?")));
  const Trial word(bodies(body("arm", "fixed")));
  EXPECT_THAT(word.faults(), ElementsAre(HasSubstr("SC2005")));
}

TEST(Body, HangsOnTheHubOrAnotherBody) {
  const Trial unknown(bodies(body("arm", kHinge) + body("hand", kHinge, ", parent: amr")));
  EXPECT_THAT(unknown.faults(), ElementsAre(HasSubstr("SC3003 body `hand` is mounted on unknown "
                                                      "`amr` (did you mean `arm`?)")));
  const Trial wheel(
      bodies(body("arm", kHinge, ", parent: rw"),
             "wheels: [{name: rw, axis: [1, 0, 0], spin_inertia: 1, transverse_inertia: 1}]\n"));
  EXPECT_THAT(wheel.faults(), ElementsAre(HasSubstr("SC3004 body `arm` cannot be mounted on wheel "
                                                    "`rw` (mount it on `hub` or on a body)")));
}

TEST(Body, HangsOnNothingInACircle) {
  const Trial three(bodies(body("c", kHinge, ", parent: d") + body("d", kHinge, ", parent: e") +
                           body("e", kHinge, ", parent: d") + body("b", kHinge)));
  EXPECT_THAT(three.faults(), ElementsAre(HasSubstr("SC3005 body `d` hangs on itself by way of "
                                                    "`e`")));
  const Trial own(bodies(body("a", kHinge, ", parent: a")));
  EXPECT_THAT(own.faults(), ElementsAre(HasSubstr("SC3005 body `a` is its own parent")));
  std::string ring = body("r9", kHinge, ", parent: r0");
  for (int i = 0; i < 9; ++i) {
    ring += body(fmt::format("r{}", i), kHinge, fmt::format(", parent: r{}", i + 1));
  }
  EXPECT_THAT(Trial(bodies(ring)).faults(), ElementsAre(HasSubstr("by way of 9 others")));
}

TEST(Body, IsTurnedFromItsParentByAnyFormThatNeedsNoOrbit) {
  const auto turned = [](const std::string& orientation) {
    return Trial(bodies(body("arm", kHinge, ", orientation: " + orientation))).faults();
  };
  EXPECT_THAT(turned("{mrp: [0, 0, 0.2]}"), IsEmpty());
  EXPECT_THAT(turned("{align: [{axis: z, to: [1, 0, 0]}, {axis: y, to: [0, 1, 0]}]}"), IsEmpty());
  EXPECT_THAT(turned("{align: [{axis: z, to: radial}, {axis: y, to: [0, 1, 0]}]}"),
              ElementsAre(HasSubstr("SC3313 body `arm` is turned from its parent")));
  EXPECT_THAT(turned("{quaternion: [1, 1, 0, 0]}"), ElementsAre(HasSubstr("SC3311")));
}

TEST(Body, MayLeaveTheVehicleRigid) {
  const std::string spin_up = "initial: {rate: [0, 0, 0.1]}\nreferences: [spin_up]\n";
  EXPECT_THAT(Trial(bodies(body("mast", "{type: fixed}"), spin_up)).faults(), IsEmpty());
  EXPECT_THAT(Trial(bodies(body("arm", kHinge), spin_up)).codes(),
              ElementsAre(Code::kReferenceInapplicable));
}

TEST(Body, WarnsWhereABranchGrowsTooDeepForMujoco) {
  std::string chain = body("b1", kHinge);
  for (int i = 2; i <= 95; ++i) {
    chain += body(fmt::format("b{}", i), i % 2 == 0 ? "{type: fixed}" : kHinge,
                  fmt::format(", parent: b{}", i - 1));
  }
  const Trial deepest(bodies(chain));
  EXPECT_THAT(deepest.faults(), IsEmpty());
  ASSERT_TRUE(deepest.model);
  EXPECT_EQ(deepest.model->mujoco_refusal, "");
  const Trial deeper(
      bodies(chain + body("twig", kHinge, ", parent: b95") + body("leaf", kHinge, ", parent: twig"),
             "wheels:\n  - {name: rw, mount: b95, axis: [1, 0, 0], spin_inertia: 0.01, "
             "transverse_inertia: 0.01}\n"));
  EXPECT_THAT(deeper.faults(), ElementsAre(HasSubstr("SC4001 `twig` is body 96 of a chain"),
                                           HasSubstr("SC4001 `rw` is body 96 of a chain")));
  ASSERT_TRUE(deeper.model);
  EXPECT_NE(deeper.model->mujoco_refusal, "");
}

}  // namespace
}  // namespace twincraft
