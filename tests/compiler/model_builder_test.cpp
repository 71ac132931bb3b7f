// What components add reaches both halves, and wheels are folded as the header says.
#include "compiler/model_builder.h"

#include <gtest/gtest.h>

#include "tests/compiler/vehicles.h"

namespace twincraft {
namespace {

using test::boom_and_wheels;
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
  const TreeBody& wheel = body(model, "rw_heavy");
  EXPECT_EQ(wheel.inertial.mass, 4.0);
  EXPECT_EQ(wheel.elements.at(0).r_EL_L, Vector3d::Zero());
  EXPECT_EQ(body(model, "boom").inertial.mass, 50.0);
  EXPECT_EQ(model.assembly.rotors[1].link, 1);
}

TEST(ModelBuilder, KeepsInitialValuesAtTheirCoordinates) {
  const Model model = boom_and_wheels().build();
  EXPECT_EQ(model.initial.joint_position, (std::vector<double>{0.2, 0.05}));
  EXPECT_EQ(model.initial.joint_rate, (std::vector<double>{-0.01, 0.0}));
  EXPECT_EQ(model.initial.rotor_speed, (std::vector<double>{100.0, -50.0}));
  EXPECT_EQ(model.degrees_of_freedom(), 10);
}

TEST(ModelBuilder, RefusesAChainThatMujocoCannotLoad) {
  EXPECT_EQ(chain(95).build().mujoco_refusal, "");
  EXPECT_NE(chain(96).build().mujoco_refusal.find("96 bodies"), std::string::npos);
}

TEST(ModelBuilder, InsistsOnAMassBeforeATensorWithoutOne) {
  ModelBuilder builder{EngineControls{}};
  builder.add_hub();
  EXPECT_THROW(builder.add_mass({}, test::lump("x", 0.0, Vector3d::Zero(), {1.0, 1.0, 1.0})),
               std::logic_error);
}

}  // namespace
}  // namespace twincraft
