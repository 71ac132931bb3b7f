// What components add reaches both halves, and wheels are folded as the header says.
#include "compiler/components/model_builder.h"

#include <gtest/gtest.h>

#include "tests/compiler/vehicles.h"

namespace twincraft {
namespace {

using test::boom_and_wheels;
using test::bracket_on_boom;
using test::chain;

const TreeBody& body(const Model& model, const std::string& name) {
  for (const TreeBody& candidate : model.tree.bodies) {
    if (candidate.name == name) return candidate;
  }
  throw std::out_of_range(name);
}

double tree_mass(const Model& model) {
  double mass = 0.0;
  for (const TreeBody& candidate : model.tree.bodies) mass += candidate.inertial.mass;
  return mass;
}

TEST(ModelBuilder, AddsALinkToBothHalvesWithItsSpring) {
  const Model model = boom_and_wheels().build();
  const TreeBody& boom = body(model, "boom");
  ASSERT_EQ(boom.joints.size(), 1u);
  EXPECT_EQ(boom.link, 1);
  EXPECT_EQ(boom.joints[0].name, "boom");
  EXPECT_EQ(boom.joints[0].stiffness, 150.0);
  EXPECT_EQ(boom.joints[0].springref, 0.1);
  EXPECT_EQ(model.assembly.links[1].name, "boom");
  EXPECT_EQ(body(model, "slider").joints[0].kind, JointKind::kSlide);
}

TEST(ModelBuilder, TakesTheTokenMassOutOfTheMountExactly) {
  const Model model = boom_and_wheels().build();
  const TreeBody& hub = model.tree.bodies[0];
  const TreeBody& wheel = body(model, "rw_light");
  EXPECT_EQ(wheel.inertial.mass, 1e-6);
  MassElement moved{"", 1e-6, wheel.pos, Matrix3d::Zero()};
  const MassProperties whole = hub.inertial + properties_of(moved);
  EXPECT_NEAR(whole.mass, 600.0, 1e-12);
  EXPECT_LT((whole.r_CL_L - Vector3d(0.1, -0.2, 0.05)).norm(), 1e-15);
  const Matrix3d bare = Vector3d(400.0, 380.0, 360.0).asDiagonal();
  EXPECT_LT((whole.I_PntC_L - bare).norm(), 1e-12);
}

// MuJoCo 3 ignores offsets and turns of an inertial below 1e-6: a token must cause none.
TEST(ModelBuilder, TakesTheTokenOutWhereItMovesNothingOfItsMount) {
  const Model model = boom_and_wheels().build();
  const TreeBody& hub = model.tree.bodies[0];
  EXPECT_EQ(hub.inertial.mass, 600.0 - 1e-6);
  EXPECT_EQ(hub.inertial.r_CL_L, Vector3d(0.1, -0.2, 0.05));
  EXPECT_EQ(hub.inertial.I_PntC_L, Matrix3d(Vector3d(400.0, 380.0, 360.0).asDiagonal()));
  EXPECT_EQ(body(model, "rw_light").pos, hub.inertial.r_CL_L);
  EXPECT_EQ(model.tree.wheels[0].center, Vector3d(0.3, 0.0, 0.1));
  EXPECT_EQ(model.tree.bodies.at(static_cast<std::size_t>(model.tree.wheels[0].body)).name,
            "rw_light");
}

TEST(ModelBuilder, LeavesTheTokenOnTopWithoutCompensation) {
  EngineControls controls;
  controls.compensate = false;
  controls.wheel_mass = 0.01;
  const Model model = boom_and_wheels(controls).build();
  EXPECT_EQ(model.tree.bodies[0].inertial.mass, 600.0);
  EXPECT_NEAR(tree_mass(model), 600.0 + 50.0 + 5.0 + 4.0 + 0.01, 1e-12);
  ASSERT_EQ(body(model, "rw_light").elements.size(), 1u);
  EXPECT_EQ(body(model, "rw_light").elements[0].mass, 0.01);
}

TEST(ModelBuilder, CarriesAMasslessWheelsTensorOnItsMountInBothHalves) {
  const Model model = boom_and_wheels().build();
  const MassElement& link = model.assembly.links[0].elements.at(0);
  const MassElement& tree = model.tree.bodies[0].elements.at(0);
  EXPECT_EQ(link.I_PntE_L, tree.I_PntE_L);
  EXPECT_NEAR(link.I_PntE_L.trace(), 1140.0 + 0.08 * 2.2, 1e-12);
  EXPECT_NEAR(model.tree.bodies[0].inertial.I_PntC_L.trace(), 1140.0, 1e-5);
  EXPECT_TRUE(body(model, "rw_light").elements.empty());
}

TEST(ModelBuilder, GivesAWheelWithMassItsOwnElementInBothHalves) {
  const Model model = boom_and_wheels().build();
  const Link& boom = model.assembly.links[1];
  ASSERT_EQ(boom.elements.size(), 2u);
  EXPECT_EQ(boom.elements[1].name, "rw_heavy");
  EXPECT_EQ(boom.elements[1].r_EL_L, Vector3d(0.5, 0.2, 0.0));
  const TreeBody& on_boom = body(model, "boom");
  ASSERT_EQ(on_boom.elements.size(), 2u);
  EXPECT_EQ(on_boom.elements[1].name, "rw_heavy");
  EXPECT_EQ(on_boom.elements[1].r_EL_L, Vector3d(0.5, 0.2, 0.0));
  EXPECT_EQ(on_boom.elements[1].I_PntE_L, boom.elements[1].I_PntE_L);
  EXPECT_EQ(model.assembly.rotors[1].link, 1);
}

TEST(ModelBuilder, LeavesOnlyATokenOfAWheelsMassInItsBody) {
  const Model model = boom_and_wheels().build();
  const TreeBody& boom = body(model, "boom");
  const TreeBody& wheel = body(model, "rw_heavy");
  EXPECT_EQ(wheel.inertial.mass, 1e-6);
  EXPECT_TRUE(wheel.elements.empty());
  EXPECT_EQ(wheel.pos, boom.inertial.r_CL_L);
  EXPECT_NEAR(boom.inertial.mass, 54.0 - 1e-6, 1e-14);
  const Vector3d center = (50.0 * Vector3d(1.2, 0.0, 0.0) + 4.0 * Vector3d(0.5, 0.2, 0.0)) / 54.0;
  EXPECT_LT((boom.inertial.r_CL_L - center).norm(), 1e-15);
  // The wheel's body brings the wheel's tensor; the mount has its mass as that of a point.
  const double bare = 3.0 + 20.0 + 21.0;
  const double apart = (Vector3d(1.2, 0.0, 0.0) - Vector3d(0.5, 0.2, 0.0)).squaredNorm();
  EXPECT_NEAR(boom.inertial.I_PntC_L.trace(), bare + 2.0 * 50.0 * 4.0 / 54.0 * apart, 1e-12);
}

TEST(ModelBuilder, TakesNoMoreThanAWheelsOwnMassOutOfItsMount) {
  EngineControls controls;
  controls.wheel_mass = 100.0;
  controls.compensate = false;
  const Model model = boom_and_wheels(controls).build();
  EXPECT_EQ(body(model, "rw_heavy").inertial.mass, 4.0);
  EXPECT_NEAR(body(model, "boom").inertial.mass, 50.0, 1e-13);
}

TEST(ModelBuilder, PutsWhatAFixedBodyCarriesOnItsLink) {
  const Model model = bracket_on_boom().build();
  const Link& boom = model.assembly.links.at(1);
  ASSERT_EQ(boom.elements.size(), 3u);
  EXPECT_EQ(boom.elements[1].name, "bracket");
  EXPECT_EQ(boom.elements[2].name, "rw_heavy");
  const TreeBody& bracket = body(model, "bracket");
  EXPECT_TRUE(bracket.joints.empty());
  EXPECT_EQ(bracket.link, 1);
  const Matrix3d turn = bracket.quat.toRotationMatrix();
  EXPECT_LT((boom.elements[1].r_EL_L - (bracket.pos + turn * Vector3d(0.1, 0.2, 0.0))).norm(),
            1e-15);
  EXPECT_LT(
      (model.assembly.rotors[0].axis_L - turn * body(model, "rw_light").joints[0].axis).norm(),
      1e-15);
  EXPECT_EQ(model.assembly.links.at(2).parent, 1);  // the finger
}

TEST(ModelBuilder, CarriesAMasslessWheelOfAFixedBodyOnThatBodysElement) {
  const Model model = bracket_on_boom().build();
  const std::vector<MassElement>& on_boom = model.assembly.links.at(1).elements;
  const double wheel = 0.08 * 2.2;  // trace: Js + 2 Jt
  EXPECT_EQ(on_boom.at(0).I_PntE_L.trace(), 44.0);
  EXPECT_NEAR(on_boom.at(1).I_PntE_L.trace(), 1.2 + wheel, 1e-14);
  EXPECT_NEAR(body(model, "bracket").elements.at(0).I_PntE_L.trace(), 1.2 + wheel, 1e-14);
  EXPECT_NEAR(body(model, "bracket").inertial.mass, 6.0 + 4.0 - 2e-6, 1e-14);
}

TEST(ModelBuilder, TurnsALoadOnAFixedBodyIntoTheAxesOfItsLink) {
  ModelBuilder builder = bracket_on_boom();
  Load load;
  load.force_M[0].entries = {{1.0, 2.0}, {3.0, 0.0}};
  load.force_M[1] = Schedule::constant(0.5);
  load.r_FL_L = Vector3d(0.1, 0.0, 0.0);
  builder.add_load(builder.find_mount("bracket"), load);
  const Model model = std::move(builder).build();
  const TreeBody& bracket = body(model, "bracket");
  const Matrix3d turn = bracket.quat.toRotationMatrix();
  const Load& turned = model.loads.at(0);
  EXPECT_EQ(turned.link, 1);
  for (const double time : {0.0, 2.0, 4.0}) {
    const Vector3d force(turned.force_L[0].at(time), turned.force_L[1].at(time),
                         turned.force_L[2].at(time));
    const Vector3d written(time == 2.0 ? 2.0 : 0.0, 0.5, 0.0);
    EXPECT_LT((force - turn * written).norm(), 1e-15) << time;
  }
  EXPECT_LT((*turned.r_FL_L - bracket.pos - turn * Vector3d(0.1, 0.0, 0.0)).norm(), 1e-15);
}

TEST(ModelBuilder, KeepsInitialValuesAtTheirCoordinates) {
  const Model model = boom_and_wheels().build();
  EXPECT_EQ(model.initial.joint_position, (std::vector<double>{0.2, 0.05}));
  EXPECT_EQ(model.initial.joint_rate, (std::vector<double>{-0.01, 0.0}));
  EXPECT_EQ(model.initial.wheel_rate, (std::vector<double>{100.0, -50.0}));
  EXPECT_EQ(model.degrees_of_freedom(), 10);
}

TEST(ModelBuilder, RefusesAChainThatMujocoCannotLoad) {
  EXPECT_EQ(chain(95).build().mujoco_refusal, "");
  EXPECT_NE(chain(96).build().mujoco_refusal.find("96 bodies"), std::string::npos);
}

TEST(ModelBuilder, RefusesMoreCoordinatesThanMujocoCanLoad) {
  EXPECT_EQ(chain(993, 90).build().mujoco_refusal, "");
  EXPECT_NE(chain(994, 90).build().mujoco_refusal.find("994 joints and wheels"), std::string::npos);
}

TEST(ModelBuilder, InsistsOnAMassBeforeATensorWithoutOne) {
  ModelBuilder builder{EngineControls{}};
  builder.add_hub();
  EXPECT_THROW(builder.add_mass({}, test::lump("x", 0.0, Vector3d::Zero(), {1.0, 1.0, 1.0})),
               std::logic_error);
}

}  // namespace
}  // namespace twincraft
