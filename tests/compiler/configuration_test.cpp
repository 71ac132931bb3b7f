// Forward kinematics against hand geometry and against finite differences of itself.
#include "compiler/analysis/configuration.h"

#include <gtest/gtest.h>

#include <cmath>

namespace twincraft {
namespace {

constexpr double kQuarterTurn = 1.5707963267948966;

/// Hub, a hinge about z at (1, 0, 0), and on it a slide along the link's x at (2, 0, 0).
Assembly arm() {
  Joint hinge;
  hinge.r_HP_P = Vector3d(1.0, 0.0, 0.0);
  Joint slide;
  slide.kind = JointKind::kSlide;
  slide.r_HP_P = Vector3d(2.0, 0.0, 0.0);
  slide.axis_L = Vector3d::UnitX();
  Assembly assembly;
  assembly.links = {{"hub", -1, {}, {}}, {"boom", 0, hinge, {}}, {"bead", 1, slide, {}}};
  assembly.links[0].elements = {{"hub", 3.0, Vector3d::Zero(), Matrix3d::Identity()}};
  assembly.links[2].elements = {{"bead", 1.0, Vector3d(0.0, 0.0, 0.5), Matrix3d::Identity()}};
  return assembly;
}

TEST(Configuration, TurnsWhatIsBeyondAHinge) {
  const std::vector<double> q{kQuarterTurn, 0.5}, qDot{0.0, 0.0};
  const std::vector<LinkMotion> links = configuration(arm(), q, qDot);
  EXPECT_TRUE(links[1].r_LB_B.isApprox(Vector3d(1.0, 0.0, 0.0)));
  EXPECT_TRUE(links[2].r_LB_B.isApprox(Vector3d(1.0, 2.5, 0.0)));
  EXPECT_TRUE((links[2].dcm_BL * Vector3d::UnitX()).isApprox(Vector3d::UnitY()));
}

TEST(Configuration, MovesALinkByTheRatesOfAllJointsBeforeIt) {
  const std::vector<double> q{kQuarterTurn, 0.5}, qDot{2.0, 3.0};
  const std::vector<LinkMotion> links = configuration(arm(), q, qDot);
  EXPECT_TRUE(links[2].omega_LB_B.isApprox(Vector3d(0.0, 0.0, 2.0)));
  EXPECT_TRUE(links[2].v_LB_B.isApprox(Vector3d(-5.0, 3.0, 0.0)));  // 2 rad/s x 2.5 m, 3 m/s
}

TEST(Configuration, SystemCentreAndItsRateAgreeWithFiniteDifferences) {
  const Assembly assembly = arm();
  const std::vector<double> qDot{0.7, -0.3};
  const auto center = [&](double t) {
    const std::vector<double> q{0.4 + qDot[0] * t, 0.5 + qDot[1] * t};
    return Vector3d(system_properties(assembly, configuration(assembly, q, qDot)).r_CL_L);
  };
  const std::vector<double> q{0.4, 0.5};
  const double h = 1.0e-5;
  const Vector3d difference = (center(h) - center(-h)) / (2.0 * h);
  const Vector3d rate = center_of_mass_rate(assembly, configuration(assembly, q, qDot));
  EXPECT_LT((rate - difference).norm(), 1.0e-9);  // central difference: h^2, and rounding / h
  EXPECT_GT(rate.norm(), 0.1);
}

TEST(Configuration, SystemInertiaIsAboutTheSystemCentre) {
  const std::vector<double> zero{0.0, 0.0};
  const Assembly assembly = arm();
  const MassProperties all = system_properties(assembly, configuration(assembly, zero, zero));
  EXPECT_DOUBLE_EQ(all.mass, 4.0);
  EXPECT_TRUE(all.r_CL_L.isApprox(Vector3d(0.75, 0.0, 0.125)));
  // Two unit tensors and the reduced mass 3 x 1 / 4 at (3, 0, 0.5): y sees both offsets.
  EXPECT_DOUBLE_EQ(all.I_PntC_L(1, 1), 2.0 + 0.75 * (9.0 + 0.25));
}

}  // namespace
}  // namespace twincraft
