// Claims about the proof: it passes for one machine built twice, and every kind of difference
// between two machines is found and named.
#include "runtime/study/proof.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "compiler/emit_mjcf.h"
#include "runtime/bsm/engine.h"
#include "runtime/mujoco/engine.h"
#include "runtime/study/random_state.h"
#include "tests/support/sample_models.h"

namespace twincraft {
namespace {

using testing::HasSubstr;

Model scheduled(Model model) {
  model.simulation.duration = 100.0;
  return model;
}

Bundle bundle_of(Model model) {
  Bundle bundle;
  bundle.mjcf = emit_mjcf(model);
  bundle.model = std::move(model);
  return bundle;
}

/// The proof of a model against itself with one change.
ProofReport against(const Model& model, const std::function<void(Model&)>& change) {
  Model changed = model;
  change(changed);
  const auto a = make_bsm_engine(model);
  const auto b = make_bsm_engine(changed);
  return prove(model, *a, *b);
}

std::vector<std::string> failing(const ProofReport& report) {
  std::vector<std::string> names;
  for (const ProofLine& line : report.lines)
    if (!line.pass()) names.push_back(line.what);
  return names;
}

TEST(Proof, HoldsForEverySampleVehicle) {
  for (const Model& model :
       {test::offset_hub(), test::wheels_and_panels(), test::two_chains(4), test::menagerie()}) {
    const ProofReport report = prove(bundle_of(scheduled(model)));
    EXPECT_TRUE(report.pass()) << model.name << "\n" << to_text(report);
  }
}

TEST(Proof, HoldsForEitherChartAndFrame) {
  Model model = scheduled(test::wheels_and_panels());
  model.engines.attitude = AttitudeChart::kQuaternion;
  model.engines.frame = MujocoFrame::kInertial;
  const ProofReport report = prove(bundle_of(model));
  EXPECT_TRUE(report.pass()) << to_text(report);
}

TEST(Proof, GivesTheSameNumbersEveryTime) {
  const Bundle bundle = bundle_of(scheduled(test::wheels_and_panels()));
  EXPECT_EQ(to_text(prove(bundle)), to_text(prove(bundle)));
}

TEST(Proof, FindsAPartPerBillionOfMass) {
  const ProofReport report = against(scheduled(test::wheels_and_panels()), [](Model& model) {
    model.assembly.links[0].elements[0].mass *= 1.0 + 1.0e-9;
  });
  EXPECT_FALSE(report.pass());
  EXPECT_THAT(failing(report), testing::Contains("mass"));
}

TEST(Proof, NamesTheJointWhoseSpringIsSofter) {
  const Model model = scheduled(test::wheels_and_panels());
  const ProofReport report = against(
      model, [](Model& changed) { changed.assembly.links[1].joint.stiffness *= 1.0 - 1.0e-8; });
  EXPECT_THAT(failing(report), testing::Contains("hinge accelerations"));
  EXPECT_THAT(failing(report), testing::Not(testing::Contains("mass matrix")));
  const auto worst = std::find_if(report.lines.begin(), report.lines.end(), [](const auto& line) {
    return line.what == "hinge accelerations";
  });
  EXPECT_THAT(worst->where, HasSubstr(model.assembly.links[1].name));
}

TEST(Proof, FindsAWheelThatTurnsTheWrongWay) {
  const ProofReport report = against(scheduled(test::wheels_and_panels()),
                                     [](Model& model) { model.assembly.rotors[0].axis_L *= -1.0; });
  EXPECT_THAT(failing(report), testing::Contains("hub angular acceleration"));
}

TEST(Proof, FindsAnInputThatIsAppliedAtTheWrongTime) {
  Model model = scheduled(test::wheels_and_panels());
  model.assembly.rotors[0].torque.entries = {{0.0, 0.01}, {50.0, -0.01}};
  const ProofReport report = against(
      model, [](Model& changed) { changed.assembly.rotors[0].torque.entries[1].time = 60.0; });
  EXPECT_THAT(failing(report), testing::Contains("wheel accelerations"));
}

TEST(Proof, FindsACoordinateTooMany) {
  const ProofReport report = against(scheduled(test::wheels_and_panels()), [](Model& model) {
    model.assembly.rotors.pop_back();
    model.initial.rotor_speed.pop_back();
  });
  EXPECT_THAT(failing(report), testing::ElementsAre("coordinate count"));
}

TEST(Proof, IsNotMadeWithoutATree) {
  Bundle bundle = bundle_of(scheduled(test::wheels_and_panels()));
  bundle.model.mujoco_refusal = "a chain of 96 segments";
  const ProofReport report = prove(bundle);
  EXPECT_FALSE(report.pass());
  EXPECT_EQ(to_text(report), "no proof: a chain of 96 segments\n");
}

TEST(Proof, SaysWhenTheSpecItselfAsksForADifference) {
  Bundle bundle = bundle_of(scheduled(test::wheels_and_panels()));
  bundle.model.gravity = {3.986e14, GravityLaw::kSystemCom, GravityLaw::kBodyCom};
  bundle.model.initial.r_BN_N = {7.0e6, 0.0, 0.0};
  const ProofReport report = prove(bundle);
  EXPECT_FALSE(report.pass());
  EXPECT_THAT(to_text(report), HasSubstr("different gravity laws"));
}

TEST(RandomStates, AreTheSameEverywhere) {
  const std::vector<RandomState> states = random_states(scheduled(test::offset_hub()), 2);
  // The first number of std::mt19937_64 for the seed, by the standard's own definition.
  std::mt19937_64 bits(20240229);
  EXPECT_EQ(states[0].time, 100.0 * (static_cast<double>(bits() >> 11) * 0x1p-53));
  EXPECT_NE(states[0].omega_BN_B, states[1].omega_BN_B);
}

TEST(RandomStates, AreOneAttitudeInEitherChart) {
  const RandomState state = random_states(scheduled(test::offset_hub()), 1).front();
  const Eigen::VectorXd mrp = state_vector(state, {AttitudeChart::kMrp, 0, 0});
  const Eigen::VectorXd quaternion = state_vector(state, {AttitudeChart::kQuaternion, 0, 0});
  const Vector3d sigma = mrp.segment<3>(6);
  const double square = sigma.squaredNorm();
  EXPECT_NEAR(quaternion[6], (1.0 - square) / (1.0 + square), 1.0e-15);
  EXPECT_NEAR((quaternion.segment<3>(7) - 2.0 * sigma / (1.0 + square)).norm(), 0.0, 1.0e-15);
  EXPECT_NEAR(quaternion.segment<4>(6).norm(), 1.0, 1.0e-15);
}

}  // namespace
}  // namespace twincraft
