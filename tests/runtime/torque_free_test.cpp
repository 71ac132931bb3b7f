// Euler's top against what must stay as it is, against a high-order integration, and in the limits
// where the elliptic functions become elementary ones.
#include "runtime/reference/torque_free.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "compiler/ir/angle.h"
#include "runtime/simulate/propagate.h"
#include "tests/runtime/toy_engine.h"

namespace twincraft {
namespace {

using testing::HasSubstr;

struct Case {
  std::string name;
  Vector3d moments;
  Vector3d omega;
};
void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

class Top : public testing::TestWithParam<Case> {
 protected:
  // Slanted, so that no axis is special, the middle moment first.
  Matrix3d axes = Eigen::AngleAxisd(0.7, Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  Matrix3d I = axes * GetParam().moments.asDiagonal() * axes.transpose();
  Vector3d omega0 = axes * GetParam().omega;
  Quaterniond q0{Eigen::AngleAxisd(2.0, Vector3d(3.0, 1.0, -1.0).normalized())};
};
INSTANTIATE_TEST_SUITE_P(
    EulerTop, Top,
    testing::Values(Case{"AboutTheLargest", {300, 400, 230}, {0.02, 0.10, -0.03}},
                    Case{"AboutTheLargestBackwards", {300, 400, 230}, {0.02, -0.10, -0.03}},
                    Case{"AboutTheSmallest", {300, 400, 230}, {0.02, 0.01, -0.13}},
                    Case{"AboutTheSmallestForwards", {300, 400, 230}, {-0.02, 0.01, 0.13}},
                    Case{"NearTheMiddle", {300, 400, 230}, {0.10, 0.001, 0.002}},
                    Case{"Oblate", {300, 400, 300}, {0.02, 0.10, -0.03}},
                    Case{"Prolate", {300, 230, 300}, {0.02, 0.10, -0.03}},
                    Case{"NearlySymmetric", {300, 400, 300.0001}, {0.02, 0.10, -0.03}},
                    Case{"Sphere", {300, 300, 300}, {0.02, 0.10, -0.03}},
                    Case{"Principal", {300, 400, 230}, {0.0, 0.0, 0.2}},
                    Case{"AcrossTheSymmetry", {300, 300, 230}, {0.06, 0.08, 0.0}},
                    Case{"AtRest", {300, 400, 230}, {0.0, 0.0, 0.0}}),
    [](const auto& one) { return one.param.name; });

TEST_P(Top, StartsAsItIsTold) {
  const EulerTop::State start = EulerTop(I, omega0, q0).at(0.0);
  EXPECT_LT((start.omega_BN_B - omega0).norm(), 1.0e-16);
  EXPECT_LT(kDegrees * principal_angle(start.q_BN, q0), 1.0e-13);
}

TEST_P(Top, KeepsItsEnergyAndAngularMomentumAtAnyTime) {
  const EulerTop top(I, omega0, q0);
  const Vector3d H0 = q0 * (I * omega0);
  const double T0 = 0.5 * omega0.dot(I * omega0);
  for (double time = 1.0; time < 1.0e6; time *= 1.7) {
    const auto [omega, q] = top.at(time);
    EXPECT_LE((q * (I * omega) - H0).norm(), 2.0e-15 * H0.norm()) << time;
    EXPECT_NEAR(0.5 * omega.dot(I * omega), T0, 2.0e-15 * T0) << time;
  }
}

TEST_P(Top, FollowsEulersAndTheKinematicEquations) {
  const EulerTop top(I, omega0, q0);
  // Central differences of fourth order: h^4 w^5/30 = 1e-13 rad/s^2, rounding w 1e-16/h.
  const double h = 0.05;
  for (const double time : {3.0, 47.0, 260.0, 999.0}) {
    const auto slope = [&](const auto& value) -> Vector3d {
      return (8.0 * (value(time + h) - value(time - h)) -
              (value(time + 2.0 * h) - value(time - 2.0 * h))) /
             (12.0 * h);
    };
    const auto [omega, q] = top.at(time);
    const Vector3d omegaDot = slope([&](double t) -> Vector3d { return top.at(t).omega_BN_B; });
    EXPECT_LT((I * omegaDot + omega.cross(I * omega)).norm(), 1.0e-10) << time;
    const Vector3d spinning = omega;  // an angle relative to now is free of the chart
    const Vector3d turned = slope([&, at = q](double t) -> Vector3d {
      const Quaterniond off = at.conjugate() * top.at(t).q_BN;
      return off.w() < 0.0 ? Vector3d(-2.0 * off.vec()) : Vector3d(2.0 * off.vec());
    });
    EXPECT_LT((turned - spinning).norm(), 1.0e-11) << time;
  }
}

Model tumbling(const Matrix3d& I, const Vector3d& omega) {
  Model model = toy_model();
  model.assembly.links[0].elements[0].I_PntE_L = I;
  model.initial.omega_BN_B = omega;
  model.simulation.method = Method::kRkf78;
  for (Tolerance* tolerance :
       {&model.simulation.tolerance.attitude, &model.simulation.tolerance.rate,
        &model.simulation.tolerance.position, &model.simulation.tolerance.velocity})
    *tolerance = {1.0e-13, 1.0e-13};
  model.simulation.step = 10.0;
  model.simulation.duration = 1000.0;
  model.simulation.record = 10.0;
  return model;
}

TEST_P(Top, IsWhatAnIntegrationOfHighOrderFinds) {
  const Model model = tumbling(I, omega0);
  ToyEngine engine(model);
  const auto found =
      deviations(ReferenceKind::kTorqueFree, model, propagate(engine, model).samples);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].metric, "attitude_deg");
  EXPECT_EQ(found[1].metric, "rate_rad_s");
  // Near the middle axis an error grows by e at every 9 s of the way over.
  EXPECT_LT(found[0].max, 2.0e-8);
  EXPECT_LT(found[1].max, 1.0e-11);
}

TEST(TorqueFree, SeesARateErrorOfAPicoradianPerSecond) {
  const Model model = tumbling(Vector3d(300, 400, 230).asDiagonal(), {0.02, 0.1, -0.03});
  ToyEngine engine(model);
  std::vector<Observation> samples = propagate(engine, model).samples;
  samples[50].omega_BN_B.x() += 1.0e-12;
  const auto found = deviations(ReferenceKind::kTorqueFree, model, samples);
  EXPECT_NEAR(found[1].max, 1.0e-12, 3.0e-13);  // beside the integrator's own 1e-13
  EXPECT_EQ(found[1].at, 500.0);
}

std::string reason(const Model& model, GravityLaw law = GravityLaw::kNone) {
  return inapplicable(ReferenceKind::kTorqueFree, model, law).value_or("");
}

TEST(TorqueFree, AppliesAtAnySymmetryAndAtRest) {
  Model model = toy_model();
  for (const Vector3d& moments :
       {Vector3d(3, 3, 3), Vector3d(3, 3, 5), Vector3d(3, 4, 3), Vector3d(3, 4, 5)})
    for (const Vector3d& omega :
         {Vector3d(0, 0, 0), Vector3d(0, 0.1, 0), Vector3d(0.1, 0.1, 0.1)}) {
      model.assembly.links[0].elements[0].I_PntE_L = moments.asDiagonal();
      model.initial.omega_BN_B = omega;
      EXPECT_EQ(reason(model), "") << moments.transpose() << " " << omega.transpose();
    }
}

TEST(TorqueFree, AppliesToARigidBodyThatNothingTurns) {
  Model model = toy_model();
  EXPECT_EQ(reason(model), "");
  EXPECT_EQ(reason(model, GravityLaw::kSystemCom), "");
  EXPECT_THAT(reason(model, GravityLaw::kBodyGradient), HasSubstr("gravity turns"));
  push_about_z(model, Schedule::constant(0.1));
  EXPECT_THAT(reason(model), HasSubstr("the loads have a torque"));
  model.loads[0].torque_L[2] = {{{2.0 * model.simulation.duration, 0.1}}};
  EXPECT_EQ(reason(model), "") << "after the run";
  model.loads[0].force_L[0] = Schedule::constant(2.0);
  model.loads[0].r_FL_L.reset();
  EXPECT_EQ(reason(model), "") << "a force at the centre of mass";
  model.loads[0].r_FL_L = Vector3d(0.0, 1.0e-6, 0.0);
  EXPECT_THAT(reason(model), HasSubstr("the loads have a torque"));
  Model jointed = toy_model();
  add_oscillator(jointed, "bob", 1.0);
  EXPECT_THAT(reason(jointed), HasSubstr("joints"));
}

}  // namespace
}  // namespace twincraft
