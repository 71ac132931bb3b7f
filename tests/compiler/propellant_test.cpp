// Tanks and thrusters: what is in a tank, what leaves it, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compiler/components/thruster.h"
#include "tests/compiler/trial.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::string tank(const std::string& shape, const std::string& more = "") {
  return "tanks:\n  - {name: main, position: [0.1, 0, -0.8], shape: {" + shape +
         "}, propellant: 1500" + more + "}\n";
}

const std::string kSphere = "sphere: {radius: 0.75}";

std::string engine(const std::string& more) {
  return "  - {name: engine, direction: [0, 0, 2], thrust: 445, isp: 234" + more + "}\n";
}

TEST(Tank, HoldsASolidOfItsShapeWithoutWhatSloshes) {
  const Trial sphere(brick_with(tank(kSphere) +
                                "slosh:\n  - {name: blob, type: particle, tank: main, mass: 500, "
                                "axis: [1, 0, 0]}\n"));
  ASSERT_TRUE(sphere.model) << testing::PrintToString(sphere.faults());
  const MassElement& bulk = sphere.model->assembly.links.at(0).elements.at(1);
  EXPECT_EQ(bulk.mass, 1000.0);
  EXPECT_EQ(bulk.r_EL_L, Vector3d(0.1, 0.0, -0.8));
  EXPECT_EQ(bulk.tank, 0);
  EXPECT_NEAR((bulk.I_PntE_L - 225.0 * Matrix3d::Identity()).norm(), 0.0, 1e-12);

  const Trial cylinder(brick_with(tank("cylinder: {radius: 0.3, length: 2, axis: [0, 3, 0]}")));
  ASSERT_TRUE(cylinder.model);
  const Matrix3d expected = Vector3d(533.75, 67.5, 533.75).asDiagonal();
  EXPECT_NEAR((cylinder.model->assembly.links.at(0).elements.at(1).I_PntE_L - expected).norm(), 0.0,
              1e-12);
}

TEST(Tank, IsABodyOfItsOwnInTheTree) {
  const Trial trial(brick_with(tank(kSphere)));
  ASSERT_TRUE(trial.model);
  const TreeBody& body = trial.model->tree.bodies.at(1);
  EXPECT_EQ(body.name, "main");
  EXPECT_TRUE(body.joints.empty());
  EXPECT_EQ(body.inertial.mass, 1500.0);
  EXPECT_EQ(trial.model->tree.bodies.at(0).inertial.mass, 600.0);
}

TEST(Tank, HoldsNoMoreThanFits) {
  // 4/3 pi 0.75^3 = 1.76715 m3
  EXPECT_THAT(Trial(brick_with(tank(kSphere, ", density: 850"))).faults(), IsEmpty());
  EXPECT_THAT(Trial(brick_with(tank(kSphere, ", density: 848"))).codes(),
              ElementsAre(Code::kTankOverfilled));
}

TEST(Thruster, PushesAndDrains) {
  const Trial trial(brick_with(tank(kSphere) + "thrusters:\n" +
                               engine(", position: [0, 0, -1.5], tank: main, during: [[10, 60]]")));
  ASSERT_TRUE(trial.model) << testing::PrintToString(trial.faults());
  const Load& load = trial.model->loads.at(0);
  EXPECT_EQ(load.force_L[2].at(10.0), 445.0);
  EXPECT_EQ(load.force_L[2].at(60.0), 0.0);
  EXPECT_EQ(load.r_FL_L, Vector3d(0.0, 0.0, -1.5));
  const Tank& propellant = trial.model->tanks.at(0);
  const double flow = 445.0 / (9.80665 * 234.0);
  EXPECT_DOUBLE_EQ(propellant.mass_flow.at(20.0), flow);
  EXPECT_EQ(propellant.content_at(10.0), 1500.0);
  EXPECT_DOUBLE_EQ(propellant.content_at(30.0), 1500.0 - 20.0 * flow);
  EXPECT_DOUBLE_EQ(propellant.content_at(120.0), 1500.0 - 50.0 * flow);
}

TEST(Nozzle, IsWhereAThrusterOfAJetTankSits) {
  const std::string wrist =
      "bodies:\n  - {name: wrist, joint: {type: fixed, position: [0, 2, 0]}, orientation: {euler: "
      "{sequence: zyx, angles: [90 deg, 0, 0]}}, mass: 1, inertia: [1, 1, 1]}\n";
  const Trial trial(brick_with(wrist + tank(kSphere, ", depletion: {momentum: jet}") +
                               "thrusters:\n" +
                               engine(", mount: wrist, position: [1, 0, 0], tank: main, during: "
                                      "[[10, 60]]") +
                               "  - {name: cold, direction: [1, 0, 0], thrust: 1}\n"));
  ASSERT_TRUE(trial.model) << testing::PrintToString(trial.faults());
  ASSERT_EQ(trial.model->nozzles.size(), 1u);
  const Nozzle& nozzle = trial.model->nozzles.at(0);
  EXPECT_EQ(nozzle.name, "engine");
  EXPECT_EQ(nozzle.tank, 0);
  EXPECT_EQ(nozzle.link, 0);
  EXPECT_LT((nozzle.r_PL_L - Vector3d(0.0, 3.0, 0.0)).norm(), 1e-15);
  EXPECT_EQ(nozzle.mass_flow.at(9.0), 0.0);
  EXPECT_EQ(nozzle.mass_flow.at(10.0), trial.model->tanks.at(0).mass_flow.at(10.0));
}

TEST(Nozzle, IsNoneOfATankWhosePropellantTakesNothingAlong) {
  for (const std::string depletion : {"", ", depletion: {momentum: none}", ", depletion: {}"}) {
    const Trial trial(brick_with(tank(kSphere, depletion) + "thrusters:\n" +
                                 engine(", tank: main, during: [[10, 60]]")));
    ASSERT_TRUE(trial.model) << testing::PrintToString(trial.faults());
    EXPECT_THAT(trial.model->nozzles, IsEmpty());
  }
}

TEST(Nozzle, TakesNoOtherWord) {
  const Trial trial(brick_with(tank(kSphere, ", depletion: {momentum: jets}")));
  EXPECT_THAT(trial.codes(), ElementsAre(Code::kUnknownWord));
}

TEST(Thruster, OfNoTankDrainsNone) {
  const Trial trial(brick_with(tank(kSphere) + "thrusters:\n" + engine("")));
  ASSERT_TRUE(trial.model);
  EXPECT_TRUE(trial.model->tanks.at(0).mass_flow.is_zero());
  EXPECT_EQ(trial.model->loads.at(0).force_L[2].at(0.0), 445.0);
}

TEST(Thruster, MustNotEmptyItsTank) {
  // 1500 kg last 120 s at 12.5 kg/s, that is 12.5 * 9.80665 * 234 N.
  const auto codes = [](const std::string& thrust) {
    return Trial(brick_with(tank(kSphere) +
                            "thrusters:\n  - {name: engine, direction: [1, 0, 0], isp: 234, tank: "
                            "main, thrust: " +
                            thrust + "}\n"))
        .codes();
  };
  EXPECT_THAT(codes("28684"), IsEmpty());
  EXPECT_THAT(codes("28685"), ElementsAre(Code::kOverDepletion));
  EXPECT_THAT(codes("[[0, 57368], [60, 0]]"), IsEmpty());
  EXPECT_THAT(codes("[[0, 57368], [61, 0]]"), ElementsAre(Code::kOverDepletion));
}

}  // namespace
}  // namespace twincraft
