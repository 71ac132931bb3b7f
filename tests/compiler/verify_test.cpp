// The compiler's own comparison accepts what is one machine and names what is not.
#include "compiler/analysis/verify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/compiler/vehicles.h"

namespace twincraft {
namespace {

using test::boom_and_wheels;
using test::bracket_on_boom;
using test::chain;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Verify, AcceptsWheelsHingesAndSlides) {
  EXPECT_THAT(verify(boom_and_wheels().build()), IsEmpty());
}

TEST(Verify, AcceptsFixedBodiesAndBranches) {
  EXPECT_THAT(verify(bracket_on_boom().build()), IsEmpty());
}

TEST(Verify, AcceptsTokenMassesOnFixedBodies) {
  EngineControls controls;
  controls.wheel_mass = 2.0;
  EXPECT_THAT(verify(bracket_on_boom(controls).build()), IsEmpty());
  controls.compensate = false;
  EXPECT_THAT(verify(bracket_on_boom(controls).build()), IsEmpty());
}

TEST(Verify, AcceptsALongChain) { EXPECT_THAT(verify(chain(200).build()), IsEmpty()); }

TEST(Verify, SeesOneLinkOfAVeryLongChain) {
  Model model = chain(1500).build();
  EXPECT_THAT(verify(model), IsEmpty());
  model.tree.bodies[777].inertial.mass *= 1.001;
  EXPECT_THAT(verify(model), Contains(HasSubstr("mass matrices differ")));
}

TEST(Verify, TellsNumbersThatOverflow) {
  Model model = boom_and_wheels().build();
  EXPECT_TRUE(is_finite(model));
  model.assembly.links[1].joint.r_HP_P.x() = 1e200;
  EXPECT_FALSE(is_finite(model));
}

TEST(Verify, AcceptsTokenMassesThatWereDeclaredToBeOnTop) {
  EngineControls controls;
  controls.compensate = false;
  controls.wheel_mass = 5.0;
  EXPECT_THAT(verify(boom_and_wheels(controls).build()), IsEmpty());
}

TEST(Verify, AcceptsLargeTokensThatWereTakenOut) {
  EngineControls controls;
  controls.wheel_mass = 5.0;
  EXPECT_THAT(verify(boom_and_wheels(controls).build()), IsEmpty());
}

/// One change to the fixed body of a sound model: bodies 0 to 4 are hub, boom, bracket, finger,
/// twig.
TEST(Verify, FindsAFixedBodyThatIsNotThere) {
  const auto said = [](auto damage) {
    Model model = bracket_on_boom().build();
    EXPECT_EQ(model.tree.bodies.at(2).name, "bracket");
    damage(model.tree.bodies.at(2));
    return verify(model);
  };
  EXPECT_THAT(said([](TreeBody&) {}), IsEmpty());
  EXPECT_THAT(said([](TreeBody& bracket) { bracket.pos.y() += 1e-9; }),
              Contains(HasSubstr("mass matrices differ")));
  EXPECT_THAT(said([](TreeBody& bracket) {
                bracket.quat = bracket.quat * Eigen::AngleAxisd(1e-9, Vector3d::UnitX());
              }),
              Contains(HasSubstr("mass matrices differ")));
  EXPECT_THAT(said([](TreeBody& bracket) { bracket.inertial.mass *= 1.0 + 1e-9; }),
              Contains(HasSubstr("mass matrices differ")));
  EXPECT_THAT(said([](TreeBody& bracket) { bracket.elements.clear(); }),
              Contains(HasSubstr("gravity pulls on other masses at `boom`")));
}

/// One change to the tree of a sound model, and what verify must then say.
struct Damage {
  const char* name;
  void (*apply)(Model&);
  const char* said;
};

class VerifyFinds : public testing::TestWithParam<Damage> {};

TEST_P(VerifyFinds, TheDamage) {
  Model model = boom_and_wheels().build();
  GetParam().apply(model);
  EXPECT_THAT(verify(model), Contains(HasSubstr(GetParam().said)));
}

INSTANTIATE_TEST_SUITE_P(
    OneChange, VerifyFinds,
    testing::Values(
        Damage{"mass", [](Model& m) { m.tree.bodies[1].inertial.mass *= 1.0 + 1e-9; },
               "mass matrices differ"},
        Damage{"inertia", [](Model& m) { m.tree.bodies[0].inertial.I_PntC_L(0, 1) += 1e-6; },
               "between `rotation` and `rotation`"},
        Damage{"place", [](Model& m) { m.tree.bodies[1].pos.x() += 1e-9; }, "mass matrices differ"},
        Damage{"not_a_number", [](Model& m) { m.tree.bodies[1].inertial.mass = std::nan(""); },
               "mass matrices differ"},
        Damage{"wheel_axis", [](Model& m) { m.tree.bodies[3].joints[0].axis *= -1.0; },
               "`rw_light`"},
        Damage{"wheel_tensor", [](Model& m) { m.tree.bodies[4].inertial.I_PntC_L *= 1.0 + 1e-9; },
               "mass matrices differ"},
        Damage{"slide_direction", [](Model& m) { m.tree.bodies[2].joints[0].axis *= -1.0; },
               "`slider`"},
        Damage{"spring", [](Model& m) { m.tree.bodies[1].joints[0].stiffness += 1e-12; },
               "the joint of `boom` differs"},
        Damage{"joint_name", [](Model& m) { m.tree.bodies[1].joints[0].name = "wing"; },
               "the joint of `boom` differs"},
        Damage{"swapped_wheels",
               [](Model& m) {
                 std::swap(m.tree.wheels[0], m.tree.wheels[1]);
                 m.tree.wheels[0].rotor = 0;
               },
               "stands for another rotor"},
        Damage{"lost_coordinate", [](Model& m) { m.coordinates.pop_back(); },
               "3 coordinates are named"},
        Damage{"lost_gravity", [](Model& m) { m.tree.bodies[1].elements.clear(); },
               "gravity pulls on other masses at `boom`"}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace twincraft
