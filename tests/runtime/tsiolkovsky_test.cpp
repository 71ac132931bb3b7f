// The rocket equation against numbers worked out by hand and against quadrature.
#include "runtime/reference/tsiolkovsky.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/runtime/toy_engine.h"

namespace twincraft {
namespace {

using testing::HasSubstr;

/// 600 kg dry, 400 kg in a tank at the centre; 500 N along x of B at 2 kg/s for 100 s, then nothing
/// for 50 s, then 250 N at 1 kg/s to the end at 250 s.
Model rocket() {
  Model model = toy_model();
  MassElement& hub = model.assembly.links[0].elements[0];
  hub.mass = 600.0;
  hub.r_EL_L.setZero();
  model.assembly.links[0].elements.push_back(
      {.name = "tank", .mass = 400.0, .I_PntE_L = 50.0 * Matrix3d::Identity(), .tank = 0});
  const Schedule burn{{{0.0, 1.0}, {100.0, 0.0}, {150.0, 0.5}}};
  model.tanks.push_back({"tank", 400.0, burn.scaled(2.0)});
  Load engine;
  engine.name = "engine";
  engine.r_FL_L = Vector3d(-1.0, 0.0, 0.0);
  engine.force_L[0] = burn.scaled(500.0);
  model.loads.push_back(engine);
  model.initial.omega_BN_B.setZero();
  model.simulation.duration = 250.0;
  return model;
}

TEST(Tsiolkovsky, GainsTheLogarithmOfTheMasses) {
  const Rocket rocket(twincraft::rocket());
  const double exhaust = 250.0;  // [m/s] 500 N / 2 kg/s
  EXPECT_EQ(rocket.at(0.0).velocity.norm(), 0.0);
  EXPECT_NEAR(rocket.at(50.0).velocity.x(), exhaust * std::log(1000.0 / 900.0), 1.0e-13);
  const double first = exhaust * std::log(1000.0 / 800.0);
  EXPECT_NEAR(rocket.at(100.0).velocity.x(), first, 1.0e-13);
  EXPECT_NEAR(rocket.at(130.0).velocity.x(), first, 1.0e-13);
  EXPECT_NEAR(rocket.at(250.0).velocity.x(), first + exhaust * std::log(800.0 / 700.0), 2.0e-13);
  EXPECT_EQ(rocket.at(250.0).velocity.y(), 0.0);
}

TEST(Tsiolkovsky, TravelsTheIntegralOfItsVelocity) {
  const Rocket rocket(twincraft::rocket());
  // Simpson on intervals of 1 s: exact to h^4/2880 v'''' t = 1e-13 relative.
  double travelled = 0.0;
  for (double time = 0.0; time < 250.0; time += 1.0)
    travelled += (rocket.at(time).velocity.x() + 4.0 * rocket.at(time + 0.5).velocity.x() +
                  rocket.at(time + 1.0).velocity.x()) /
                 6.0;
  EXPECT_NEAR(rocket.at(250.0).position.x(), travelled, 1.0e-11 * travelled);
}

TEST(Tsiolkovsky, IsGoodForBurntSharesOfAnySize) {
  Model model = rocket();
  model.tanks[0].mass_flow = Schedule::constant(1.0e-9);
  model.loads[0].force_L[0] = Schedule::constant(1.0);
  const Rocket::Gain gain = Rocket(model).at(200.0);
  EXPECT_NEAR(gain.velocity.x(), 0.2 * (1.0 + 1.0e-10), 1.0e-15);         // F t/m (1 + x/2)
  EXPECT_NEAR(gain.position.x(), 20.0 * (1.0 + 2.0e-10 / 3.0), 1.0e-14);  // F t^2/2m (1 + x/3)
  // The series and the logarithm meet where a quarter is burnt: F/mdot^2 (m - m1 (1 + ln(m/m1))).
  model.tanks[0].mass_flow = Schedule::constant(1.0);
  for (const double time : {249.0, 250.0, 251.0}) {
    const double left = 1000.0 - time;
    const double travelled = time + left * std::log(left / 1000.0);
    EXPECT_NEAR(Rocket(model).at(time).position.x(), travelled, 1.0e-12) << time;
  }
}

TEST(Tsiolkovsky, FindsWhatIsWrongInASample) {
  const Model model = rocket();
  const Rocket truth(model);
  std::vector<Observation> samples;
  for (const double time : {0.0, 100.0, 250.0}) {
    const Rocket::Gain gain = truth.at(time);
    Observation& sample = samples.emplace_back();
    sample.time = time;
    sample.q_BN = Quaterniond(Eigen::AngleAxisd(0.5 * M_PI, Vector3d::UnitZ()));  // x of B is y
    sample.v_CN_N = Vector3d(1.0, gain.velocity.x(), 0.0);
    sample.v_BN_N = sample.v_CN_N;
    sample.r_BN_N = Vector3d(time, gain.position.x(), 0.0);
  }
  samples[1].v_CN_N.y() += 1.0e-3;
  samples[2].r_BN_N.z() = 0.5;
  const auto found = deviations(ReferenceKind::kTsiolkovsky, model, samples);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].metric, "delta_v_relative");
  EXPECT_NEAR(found[0].max, 1.0e-3 / (250.0 * std::log(1.25)), 1.0e-12);
  EXPECT_EQ(found[1].metric, "velocity_m_s");
  EXPECT_NEAR(found[1].max, 1.0e-3, 1.0e-12);
  EXPECT_EQ(found[1].at, 100.0);
  EXPECT_EQ(found[2].metric, "position_m");
  EXPECT_NEAR(found[2].max, 0.5, 1.0e-12);
}

std::string reason(const Model& model, GravityLaw law = GravityLaw::kNone) {
  return inapplicable(ReferenceKind::kTsiolkovsky, model, law).value_or("");
}

TEST(Tsiolkovsky, AppliesToARigidRocketThatFliesStraight) {
  EXPECT_EQ(reason(rocket()), "");
  EXPECT_THAT(reason(rocket(), GravityLaw::kSystemCom), HasSubstr("gravity"));
  EXPECT_THAT(reason(toy_model()), HasSubstr("no tank drains"));
  Model turning = rocket();
  turning.initial.omega_BN_B.x() = 1.0e-3;
  EXPECT_THAT(reason(turning), HasSubstr("turns"));
  Model aside = rocket();
  aside.loads[0].r_FL_L->y() = 1.0e-3;
  EXPECT_THAT(reason(aside), HasSubstr("not through the centre of mass"));
  // On the line of thrust at first only: the tank is beside it.
  Model shifting = rocket();
  shifting.assembly.links[0].elements[1].r_EL_L.y() = 0.1;
  shifting.loads[0].r_FL_L->y() = 0.04;
  EXPECT_THAT(reason(shifting), HasSubstr("not through the centre of mass"));
  Model sloshing = rocket();
  add_oscillator(sloshing, "bob", 1.0);
  EXPECT_THAT(reason(sloshing), HasSubstr("joints"));
}

}  // namespace
}  // namespace twincraft
