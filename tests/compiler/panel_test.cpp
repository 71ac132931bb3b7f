// Panels: geometry and inertia of the segments against the published numbers.
#include "compiler/components/panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "compiler/analysis/configuration.h"
#include "tests/compiler/trial.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kHinge = "{position: [0.8, 0, 0], axis: [0, -1, 0], outboard: [1, 0, 0]}";

std::string wing(const std::string& keys, const std::string& hinge = kHinge) {
  return brick_with("panels:\n  - name: wing\n    mass: 60 kg\n    length: 3 m\n    hinge: " +
                    hinge + "\n" + keys);
}

struct Published {
  int segments;
  double mass, half_length, axial, across;
};
constexpr Published kPublished[] = {
    {1, 60.0, 1.5, 2.25, 45.0},
    {2, 30.0, 0.75, 0.28125, 5.625},
    {4, 15.0, 0.375, 0.03515625, 0.703125},
    {8, 7.5, 0.1875, 0.00439453125, 0.087890625},
    {16, 3.75, 0.09375, 0.00054931640625, 0.010986328125},
    {32, 1.875, 0.046875, 1.0e-4, 0.001373291015625},
};

TEST(Panel, DividesIntoThePublishedSegments) {
  for (const Published& row : kPublished) {
    const Trial trial(wing("    segments: " + std::to_string(row.segments) +
                           "\n    inertia: {shape: bar}\n    stiffness: 600\n"));
    ASSERT_TRUE(trial.model) << row.segments;
    const Link& tip = trial.model->assembly.links.back();
    const MassElement& element = tip.elements.at(0);
    EXPECT_EQ(tip.name, "wing." + std::to_string(row.segments));
    EXPECT_DOUBLE_EQ(element.mass, row.mass);
    EXPECT_DOUBLE_EQ(element.r_EL_L.x(), row.half_length);
    EXPECT_DOUBLE_EQ(element.I_PntE_L(0, 0), row.axial);
    EXPECT_DOUBLE_EQ(element.I_PntE_L(1, 1), row.across);
    EXPECT_DOUBLE_EQ(element.I_PntE_L(2, 2), row.across);
    EXPECT_EQ(trial.model->degrees_of_freedom(), 6 + row.segments);
  }
}

TEST(Panel, TurnsByTheRightHandAboutItsAxis) {
  const Trial trial(wing("    inertia: {shape: bar}\n    angle: 90 deg\n"));
  ASSERT_TRUE(trial.model);
  const VehicleState& state = trial.model->initial;
  const LinkMotion link =
      configuration(trial.model->assembly, state.joint_position, state.joint_rate).at(1);
  // Outboard +x turns about -y towards +z.
  EXPECT_LT((link.dcm_BL * Vector3d::UnitX() - Vector3d::UnitZ()).norm(), 1.0e-15);
  EXPECT_TRUE(link.r_LB_B.isApprox(Vector3d(0.8, 0.0, 0.0)));
}

TEST(Panel, ReadsAnInertiaOfNumbersAndAUnit) {
  const Trial trial(wing("    inertia: {value: [300, 200, 120], unit: kg dm2}\n"));
  ASSERT_TRUE(trial.model);
  const Matrix3d I = trial.model->assembly.links.at(1).elements.at(0).I_PntE_L;
  EXPECT_TRUE(I.isApprox(Vector3d(3.0, 2.0, 1.2).asDiagonal().toDenseMatrix(), 1e-15)) << I;
}

TEST(Panel, HasALinkFrameOfOutboardHingeAndNormal) {
  const Trial trial(wing("    inertia: [30, 20, 12]\n    segments: 2\n"));
  ASSERT_TRUE(trial.model);
  const Joint& root = trial.model->assembly.links.at(1).joint;
  EXPECT_EQ(root.dcm_PL0.col(0), Vector3d::UnitX());
  EXPECT_EQ(root.dcm_PL0.col(1), Vector3d(-Vector3d::UnitY()));
  EXPECT_EQ(root.dcm_PL0.col(2), Vector3d(-Vector3d::UnitZ()));
  const Joint& second = trial.model->assembly.links.at(2).joint;
  EXPECT_EQ(second.r_HP_P, Vector3d(1.5, 0.0, 0.0));
  EXPECT_EQ(second.dcm_PL0, Matrix3d(Matrix3d::Identity()));
}

TEST(Panel, TakesANumberForAllHingesOrForTheRoot) {
  const Trial one(
      wing("    inertia: {shape: bar}\n    segments: 3\n    stiffness: 600\n"
           "    damping: 5\n    rest: 0.1\n    angle: 8 deg\n    rate: 0.2\n"));
  ASSERT_TRUE(one.model);
  for (std::size_t i = 1; i <= 3; ++i) {
    EXPECT_EQ(one.model->assembly.links.at(i).joint.stiffness, 600.0);
    EXPECT_EQ(one.model->assembly.links.at(i).joint.damping, 5.0);
    EXPECT_EQ(one.model->assembly.links.at(i).joint.rest, 0.1);
  }
  EXPECT_THAT(one.model->initial.joint_position, ElementsAre(8.0 * kDegree, 0.0, 0.0));
  EXPECT_THAT(one.model->initial.joint_rate, ElementsAre(0.2, 0.0, 0.0));

  const Trial each(
      wing("    inertia: {shape: bar}\n    segments: 2\n    stiffness: [600, 500]\n"
           "    angle: [1, 2]\n"));
  ASSERT_TRUE(each.model);
  EXPECT_EQ(each.model->assembly.links.at(2).joint.stiffness, 500.0);
  EXPECT_THAT(each.model->initial.joint_position, ElementsAre(1.0, 2.0));
}

TEST(Panel, RefusesListsThatDoNotMatchItsHinges) {
  const Trial trial(
      wing("    inertia: {shape: bar}\n    segments: 3\n    stiffness: [600]\n"
           "    rate: [1, 2, 3, 3]\n"));
  EXPECT_THAT(trial.faults(),
              ElementsAre(HasSubstr("15:16 SC3202 `stiffness` of panel `wing` lists 1 values for 3 "
                                    "hinges"),
                          HasSubstr("16:11 SC3202 `rate` of panel `wing` lists 4 values for 3")));
}

TEST(Panel, IsASolidCuboidWhenItIsAPlate) {
  const Trial trial(wing("    inertia: {shape: plate, width: 1.2 m, thickness: 20 mm}\n"));
  ASSERT_TRUE(trial.model);
  const Matrix3d I = trial.model->assembly.links.at(1).elements.at(0).I_PntE_L;
  EXPECT_DOUBLE_EQ(I(0, 0), 60.0 / 12.0 * (1.2 * 1.2 + 0.02 * 0.02));
  EXPECT_DOUBLE_EQ(I(1, 1), 60.0 / 12.0 * (3.0 * 3.0 + 0.02 * 0.02));
  EXPECT_DOUBLE_EQ(I(2, 2), 60.0 / 12.0 * (3.0 * 3.0 + 1.2 * 1.2));
}

TEST(Panel, RefusesKeysOfTheOtherShapeAndMissingOnes) {
  const Trial bar(wing("    inertia: {shape: bar, width: 1}\n"));
  EXPECT_THAT(bar.faults(), ElementsAre(HasSubstr("13:34 SC3201 a bar has no `width`")));
  const Trial plate(wing("    inertia: {shape: plate, width: 1}\n"));
  EXPECT_THAT(plate.faults(), ElementsAre(HasSubstr("SC3201 the plate of panel `wing` has no "
                                                    "`thickness`")));
}

TEST(Panel, RefusesAnInertiaThatNoSegmentHas) {
  const Trial tensor(wing("    inertia: [30, 20, 51]\n"));
  EXPECT_THAT(tensor.codes(), ElementsAre(Code::kInertiaTriangle));
  const Trial fat_bar(wing("    inertia: {shape: bar, axial_ratio: 2.1}\n"));
  EXPECT_THAT(fat_bar.codes(), ElementsAre(Code::kInertiaTriangle));
}

TEST(Panel, MakesAnAlmostPerpendicularHingeExactAndRefusesMore) {
  const Trial close(wing("    inertia: {shape: bar}\n",
                         "{position: [0, 0, 0], axis: [0, 1, 0], outboard: [1, 9.0e-10, 0]}"));
  ASSERT_TRUE(close.model);
  const Matrix3d dcm = close.model->assembly.links.at(1).joint.dcm_PL0;
  EXPECT_EQ(dcm.col(0).dot(dcm.col(1)), 0.0);
  const Trial off(wing("    inertia: {shape: bar}\n",
                       "{position: [0, 0, 0], axis: [0, 1, 0], outboard: [1, 1, 0]}"));
  EXPECT_THAT(off.codes(), ElementsAre(Code::kNotPerpendicular));
  EXPECT_THAT(off.faults().at(0), HasSubstr("12:61 SC3105 `outboard` and `axis` of panel `wing`"));
  EXPECT_THAT(off.faults().at(0), HasSubstr("| 12:40 `axis` is written here"));
}

TEST(Panel, CountsItsSegments) {
  for (const char* count : {"0", "-3", "1.0e9", "1000000000", "10001", "2.5"}) {
    const Trial trial(
        wing("    inertia: {shape: bar}\n    segments: " + std::string(count) + "\n"));
    EXPECT_EQ(trial.faults().size(), 1u) << count;
    EXPECT_FALSE(trial.model) << count;
  }
}

TEST(Panel, WarnsThatMujocoCannotLoadADeepChainAndGoesOn) {
  const Trial deepest(wing("    inertia: {shape: bar}\n    segments: 95\n"));
  EXPECT_THAT(deepest.faults(), IsEmpty());
  const Trial deeper(wing("    inertia: {shape: bar}\n    segments: 96\n"));
  EXPECT_THAT(deeper.codes(), ElementsAre(Code::kChainTooDeep));
  EXPECT_EQ(deeper.diagnostics.all().at(0).severity, Severity::kWarning);
  ASSERT_TRUE(deeper.model);
  EXPECT_NE(deeper.model->mujoco_refusal, "");
}

TEST(Panel, RefusesNegativeSpringsAndDampers) {
  EXPECT_EQ(Trial(wing("    inertia: {shape: bar}\n    stiffness: -1\n")).codes(),
            std::vector<Code>{Code::kOutOfRange});
  EXPECT_EQ(Trial(wing("    inertia: {shape: bar}\n    damping: -1\n")).codes(),
            std::vector<Code>{Code::kOutOfRange});
}

}  // namespace
}  // namespace twincraft
