// Reaction wheels: tensors, masses, mounts.
#include "compiler/components/wheel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compiler/analysis/configuration.h"
#include "tests/compiler/trial.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string wheel(const std::string& keys) {
  return brick_with("wheels:\n  - {name: rw, spin_inertia: 0.08, transverse_inertia: 0.04, " +
                    keys + "}\n");
}

TEST(Wheel, WithoutMassAddsItsWholeTensorToTheMount) {
  // Three wheels of the paper: every axis of the hub gains Js + 2 Jt = 0.16.
  const Trial trial(brick_with(R"(wheels:
  - {name: x, axis: [1, 0, 0], spin_inertia: 0.08, transverse_inertia: 0.04}
  - {name: y, axis: [0, 2, 0], spin_inertia: 0.08, transverse_inertia: 0.04}
  - {name: z, axis: [0, 0, 1], spin_inertia: 0.08, transverse_inertia: 0.04, position: [1, 2, 3]}
)"));
  ASSERT_TRUE(trial.model);
  const Link& hub = trial.model->assembly.links.at(0);
  const MassProperties all =
      system_properties(trial.model->assembly, configuration(trial.model->assembly, {}, {}));
  EXPECT_EQ(hub.elements.at(0).mass, 600.0);
  EXPECT_TRUE(
      all.I_PntC_L.isApprox(Matrix3d(Vector3d(400.16, 380.16, 360.16).asDiagonal()), 1.0e-15));
  EXPECT_EQ(trial.model->assembly.rotors.at(1).axis_L, Vector3d::UnitY());
  EXPECT_EQ(trial.model->degrees_of_freedom(), 9);
}

TEST(Wheel, AboutASlantedAxisHasTheSpinInertiaAboutThatAxis) {
  const Trial trial(wheel("axis: [1, 1, 0], mass: 2"));
  ASSERT_TRUE(trial.model);
  const Matrix3d I = trial.model->assembly.links.at(0).elements.at(1).I_PntE_L;
  const Vector3d along = Vector3d(1.0, 1.0, 0.0).normalized();
  const Vector3d across = Vector3d(1.0, -1.0, 0.0).normalized();
  EXPECT_DOUBLE_EQ(along.dot(I * along), 0.08);
  EXPECT_DOUBLE_EQ(across.dot(I * across), 0.04);
  EXPECT_DOUBLE_EQ(I(2, 2), 0.04);
}

TEST(Wheel, WithMassIsAMassAtItsPosition) {
  const Trial trial(wheel("axis: [0, 0, 1], mass: 5 kg, position: [0, 0, 300 mm]"));
  ASSERT_TRUE(trial.model);
  const MassElement& element = trial.model->assembly.links.at(0).elements.at(1);
  EXPECT_EQ(element.mass, 5.0);
  EXPECT_EQ(element.r_EL_L, Vector3d(0.0, 0.0, 0.3));
}

TEST(Wheel, StartsAtItsSpeedAndCarriesItsTorque) {
  const Trial trial(wheel("axis: [0, 0, 1], speed: 60 rpm, torque: [[10 s, 0.2]]"));
  ASSERT_TRUE(trial.model);
  EXPECT_NEAR(trial.model->initial.wheel_rate.at(0), 6.283185307179586, 1.0e-14);
  const Coordinate& coordinate = trial.model->coordinates.at(0);
  EXPECT_EQ(coordinate.name, "rw");
  EXPECT_EQ(coordinate.kind, Coordinate::Kind::kWheel);
  EXPECT_EQ(trial.model->assembly.rotors.at(0).torque.at(9.0), 0.0);
  EXPECT_EQ(trial.model->assembly.rotors.at(0).torque.at(10.0), 0.2);
}

TEST(Wheel, MaySpinAboutAThinDiscsAxisButNoMore) {
  EXPECT_THAT(Trial(wheel("axis: [1, 2, 3]")).faults(), IsEmpty());
  const Trial trial(
      brick_with("wheels:\n  - {name: rw, axis: [0, 0, 1], spin_inertia: 0.0801, "
                 "transverse_inertia: 0.04}\n"));
  EXPECT_THAT(trial.faults(), ElementsAre(HasSubstr("9:47 SC3102 inertia of wheel `rw`")));
}

TEST(Wheel, CannotBeMountedOnAPanelOrAWheelOrNothing) {
  const std::string panel =
      "panels:\n  - {name: wing, mass: 50, length: 2, inertia: [3, 2, 2], hinge: {position: [1, 0, "
      "0], axis: [0, 1, 0], outboard: [1, 0, 0]}}\n";
  const Trial on_panel(wheel("axis: [0, 0, 1], mount: wing") + panel);
  EXPECT_THAT(on_panel.faults(),
              ElementsAre(HasSubstr("SC3004 wheel `rw` cannot be mounted on panel `wing`")));
  const Trial on_itself(wheel("axis: [0, 0, 1], mount: rw"));
  EXPECT_THAT(on_itself.faults(),
              ElementsAre(HasSubstr("SC3004 wheel `rw` cannot be mounted on wheel `rw`")));
  const Trial on_nothing(wheel("axis: [0, 0, 1], mount: hbu"));
  EXPECT_THAT(on_nothing.faults(), ElementsAre("9:86 SC3003 wheel `rw` is mounted on unknown `hbu` "
                                               "(did you mean `hub`?)"));
}

}  // namespace
}  // namespace twincraft
