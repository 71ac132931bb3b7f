// The references against other ways to the same truth, against the integrators, and what they
// refuse.
#include "runtime/reference/reference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "runtime/reference/kepler.h"
#include "runtime/reference/spin_up.h"
#include "runtime/simulate/propagate.h"
#include "tests/runtime/toy_engine.h"

namespace twincraft {
namespace {

using testing::HasSubstr;
using Real = long double;

constexpr double kMu = 3.98600436e14;  // [m^3/s^2]

/// The perifocal route: mean anomaly, Kepler's equation, radius and direction in the orbital plane
/// with periapsis on x and motion towards y. Starts at periapsis.
struct Periapsis {
  Real a, e;
  Real rate() const { return std::sqrt(Real{kMu} / (a * a * a)); }
  KeplerOrbit::State at(Real time) const {
    const Real M = rate() * time;
    Real E = M;
    for (int i = 0; i < 200; ++i) E -= (E - e * std::sin(E) - M) / (1.0L - e * std::cos(E));
    const Real across = std::sqrt(1.0L - e * e);
    const Real speed = rate() * a / (1.0L - e * std::cos(E));
    const auto vector = [](Real x, Real y) {
      return Vector3d(static_cast<double>(x), static_cast<double>(y), 0.0);
    };
    return {vector(a * (std::cos(E) - e), a * across * std::sin(E)),
            vector(-speed * std::sin(E), speed * across * std::cos(E))};
  }
};

class EveryEccentricity : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(KeplerOrbit, EveryEccentricity, testing::Values(0.0, 0.01, 0.3, 0.9));

TEST_P(EveryEccentricity, FollowsTheOrbitalElementsOverManyRevolutions) {
  const Periapsis elements{7.0e6L, GetParam()};
  const KeplerOrbit::State start = elements.at(0.0L);
  const KeplerOrbit orbit(start.r, start.v, kMu);
  // The start is rounded to a double, so the period is not quite that of the elements.
  for (const double time : {0.0, 1.0, 1457.0, 2914.0, 5828.0, 11657.0, 60000.0}) {
    const KeplerOrbit::State truth = elements.at(static_cast<Real>(time));
    const double rounding = 2.0e-9 + 2.0e-11 * time / (1.0 - GetParam());
    const double acceleration = kMu / truth.r.squaredNorm();
    EXPECT_LT((orbit.at(time).r - truth.r).norm(), rounding) << time;
    EXPECT_LT((orbit.at(time).v - truth.v).norm(),
              4.0e-12 + rounding * acceleration / truth.v.norm())
        << time;
  }
}

/// The benchmark orbit: a = 7000 km, e = 0.01, inclined by 33.3 deg.
const Vector3d kR0(-2814237.0832776525, 5243396.7192967609, 3673809.4481125535);
const Vector3d kV0(-6214.9223200117558, -4107.6201953659565, 1244.9223786004761);

TEST(KeplerOrbit, StartsAtItsInitialStateAndReturnsAfterAPeriod) {
  const KeplerOrbit orbit(kR0, kV0, kMu);
  EXPECT_NEAR(orbit.period(), 5828.516680091132, 1.0e-9);
  EXPECT_LT((orbit.at(0.0).r - kR0).norm(), 2.0e-9);
  EXPECT_LT((orbit.at(0.0).v - kV0).norm(), 2.0e-12);
  // The period is rounded to a double: half a unit in its last place is 5e-13 s of flight.
  EXPECT_LT((orbit.at(orbit.period()).r - kR0).norm(), 1.0e-8);
  EXPECT_LT((orbit.at(2.0 * orbit.period()).r - kR0).norm(), 2.0e-8);
}

TEST(KeplerOrbit, KeepsEnergyAndAngularMomentumAtEveryTime) {
  const KeplerOrbit orbit(kR0, kV0, kMu);
  const Vector3d h0 = kR0.cross(kV0);
  const double energy0 = 0.5 * kV0.squaredNorm() - kMu / kR0.norm();
  for (double time = 0.0; time < 12000.0; time += 37.0) {
    const auto [r, v] = orbit.at(time);
    EXPECT_LT((r.cross(v) - h0).norm(), 1.0e-15 * h0.norm());
    EXPECT_NEAR(0.5 * v.squaredNorm() - kMu / r.norm(), energy0, 4.0e-15 * std::abs(energy0));
  }
}

TEST(KeplerOrbit, KeepsItsDigitsUpToTheParabola) {
  // Barker's equation of the parabola through the same periapsis. The ellipse is 1e-12 away from
  // it, which at these times moves it by less than a hundred times as much.
  const Real periapsis = 7.0e6L;
  const Real speed = std::sqrt(Real{kMu} * (2.0L - 1.0e-12L) / periapsis);
  const KeplerOrbit orbit({7.0e6, 0.0, 0.0}, {0.0, static_cast<double>(speed), 0.0}, kMu);
  for (const double time : {-3000.0, -1.0, 0.0, 1.0, 100.0, 3000.0, 20000.0}) {
    // tan(nu/2) + tan^3(nu/2)/3 = W, by Cardano.
    const Real W = std::sqrt(Real{kMu} / (2.0L * periapsis * periapsis * periapsis)) * time;
    const Real root = std::cbrt(1.5L * W + std::sqrt(2.25L * W * W + 1.0L));
    const Real tangent = root - 1.0L / root;
    const Vector3d r(static_cast<double>(periapsis * (1.0L - tangent * tangent)),
                     static_cast<double>(2.0L * periapsis * tangent), 0.0);
    EXPECT_LT((orbit.at(time).r - r).norm(), 1.0e-10 * r.norm()) << time;
  }
}

Model orbit_model() {
  Model model = toy_model();
  model.gravity = {kMu, GravityLaw::kSystemCom, GravityLaw::kBodyCom};
  model.initial.r_BN_N = kR0;
  model.initial.v_BN_N = kV0;
  model.simulation.duration = 11640.0;
  model.simulation.record = 60.0;
  return model;
}

/// Largest deviation from the Kepler orbit of a run at `step` [s]: metres.
double kepler_error(double step, double duration) {
  Model model = orbit_model();
  model.simulation.step = step;
  model.simulation.duration = duration;
  model.simulation.record = 120.0;
  ToyEngine engine(model);
  const Trajectory trajectory = propagate(engine, model);
  return deviations(ReferenceKind::kKepler, model, trajectory.samples)[0].max;
}

TEST(Kepler, FindsTheErrorsOfRk4InExactArithmetic) {
  // Computed with 64-bit mantissas; the published sweep of the step gives 10.22 m to 1.09e-4 m.
  const double rounding = 2.0e-8;  // [m]
  EXPECT_NEAR(kepler_error(40.0, 11520.0), 10.221317, 1.0e-6);
  EXPECT_NEAR(kepler_error(20.0, 11520.0), 0.53672531, rounding);
  EXPECT_NEAR(kepler_error(10.0, 11520.0), 3.0350829e-2, rounding);
  EXPECT_NEAR(kepler_error(5.0, 11520.0), 1.7970404e-3, rounding);
  EXPECT_NEAR(kepler_error(2.5, 11520.0), 1.0919278e-4, rounding);
}

TEST(Kepler, FindsThePublishedErrorOfTheBaseline) {
  EXPECT_NEAR(kepler_error(10.0, 11640.0), 3.0468e-2, 1.0e-6);
}

TEST(Kepler, SaysWhenTheLargestErrorsWere) {
  Model model = orbit_model();
  const KeplerOrbit orbit(kR0, kV0, kMu);
  std::vector<Observation> samples;
  for (const double time : {0.0, 60.0, 120.0, 180.0}) {
    samples.emplace_back().time = time;
    samples.back().r_CN_N = orbit.at(time).r;
    samples.back().v_CN_N = orbit.at(time).v;
  }
  samples[1].r_CN_N.x() += 0.25;
  samples[2].v_CN_N.z() -= 1.0e-3;
  const std::vector<Deviation> found = deviations(ReferenceKind::kKepler, model, samples);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].metric, "position_m");
  EXPECT_NEAR(found[0].max, 0.25, 1.0e-8);
  EXPECT_EQ(found[0].at, 60.0);
  EXPECT_EQ(found[1].metric, "velocity_m_s");
  EXPECT_NEAR(found[1].max, 1.0e-3, 1.0e-11);
  EXPECT_EQ(found[1].at, 120.0);
}

std::string kepler_reason(const Model& model, GravityLaw law) {
  return inapplicable(ReferenceKind::kKepler, model, law).value_or("");
}

TEST(Kepler, AppliesToASinglePointUnderEveryLawOfGravity) {
  const Model model = orbit_model();
  for (const auto law : {GravityLaw::kSystemCom, GravityLaw::kBodyCom, GravityLaw::kBodyGradient})
    EXPECT_EQ(kepler_reason(model, law), "");
  EXPECT_THAT(kepler_reason(model, GravityLaw::kNone), HasSubstr("no gravity"));
}

TEST(Kepler, RefusesGravityAtSeveralPointsButNotAtTheSystemCentreOfMass) {
  Model model = orbit_model();
  add_oscillator(model, "bob", 1.0);
  model.assembly.links[1].elements = {{.name = "bob", .mass = 25.0}};
  EXPECT_EQ(kepler_reason(model, GravityLaw::kSystemCom), "");
  EXPECT_THAT(kepler_reason(model, GravityLaw::kBodyCom), HasSubstr("several points"));

  Model tank = orbit_model();
  tank.assembly.links[0].elements.push_back(
      {.name = "tank", .mass = 10.0, .r_EL_L = Vector3d::UnitX()});
  EXPECT_EQ(kepler_reason(tank, GravityLaw::kSystemCom), "");
  EXPECT_THAT(kepler_reason(tank, GravityLaw::kBodyCom), HasSubstr("several points"));
}

TEST(Kepler, LooksAtTheMassesOfTheTreeToo) {
  Model model = orbit_model();
  TreeBody hub;
  hub.link = 0;
  hub.elements = model.assembly.links[0].elements;
  TreeBody wheel;
  wheel.parent = 0;
  wheel.elements = {{.name = "rw", .mass = 1.0e-6}};
  model.tree.bodies = {hub, wheel};
  EXPECT_EQ(kepler_reason(model, GravityLaw::kBodyCom), "") << "the wheel is at the hub's centre";
  model.tree.bodies[1].pos = Vector3d::UnitY();
  EXPECT_THAT(kepler_reason(model, GravityLaw::kBodyCom), HasSubstr("several points"));
}

TEST(Kepler, RefusesAForceDuringTheRunOnly) {
  Model model = orbit_model();
  push_about_z(model, Schedule::constant(1.0));
  EXPECT_EQ(kepler_reason(model, GravityLaw::kSystemCom), "") << "a torque moves no centre of mass";
  model.loads[0].force_L[1] = {{{20000.0, 5.0}}};
  EXPECT_EQ(kepler_reason(model, GravityLaw::kSystemCom), "") << "after the run";
  model.loads[0].force_L[1] = {{{100.0, 5.0}, {200.0, 0.0}}};
  EXPECT_THAT(kepler_reason(model, GravityLaw::kSystemCom), HasSubstr("`push` applies a force"));
}

TEST(Kepler, RefusesAnOpenOrbitAndAStraightFall) {
  Model model = orbit_model();
  model.initial.v_BN_N *= 1.5;
  EXPECT_THAT(kepler_reason(model, GravityLaw::kSystemCom), HasSubstr("ellipse"));
  model.initial.v_BN_N.setZero();
  EXPECT_THAT(kepler_reason(model, GravityLaw::kSystemCom), HasSubstr("ellipse"));
}

Model spin_up_model() {
  Model model = toy_model();
  model.initial.omega_BN_B = {0.0, 0.0, 0.03};
  push_about_z(model, Schedule::constant(0.4));
  model.simulation.duration = 600.0;
  model.simulation.record = 1.0;
  return model;
}

TEST(SpinUp, FindsThePublishedErrorsOfRk4) {
  const Model model = spin_up_model();
  ToyEngine engine(model);
  const Trajectory trajectory = propagate(engine, model);
  const auto found = deviations(ReferenceKind::kSpinUp, model, trajectory.samples);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].metric, "attitude_deg");
  EXPECT_NEAR(found[0].max, 2.94e-7, 0.01e-7);
  EXPECT_EQ(found[1].metric, "rate_rad_s");
  EXPECT_LT(found[1].max, 3.0e-14);
}

TEST(SpinUp, TurnsByTheQuadraticLawAboutAnyPrincipalAxisFromAnyAttitude) {
  const SpinUp spin_up{.axis_B = Vector3d(0.0, -1.0, 0.0), .rate = 0.5, .acceleration = 0.25};
  // 0.5 * 2 + 0.125 * 4 = 1.5 rad
  const Quaterniond turn = spin_up.turn(2.0);
  EXPECT_NEAR(turn.w(), std::cos(0.75), 1.0e-15);
  EXPECT_NEAR(turn.y(), -std::sin(0.75), 1.0e-15);
  EXPECT_DOUBLE_EQ(spin_up.omega_BN_B(2.0).y(), -1.0);

  Model model = toy_model();
  model.initial.q_BN = Quaterniond(Eigen::AngleAxisd(2.0, Vector3d(1.0, 2.0, 3.0).normalized()));
  model.initial.omega_BN_B = {0.0, -0.5, 0.0};
  model.simulation.step = 0.01;
  ToyEngine engine(model);
  const auto found = deviations(ReferenceKind::kSpinUp, model, propagate(engine, model).samples);
  EXPECT_LT(found[0].max, 1.0e-10);
  EXPECT_LT(found[1].max, 1.0e-15);
}

TEST(SpinUp, KeepsItsAngleAfterMillionsOfTurns) {
  Model model = toy_model();  // a ball: any axis is a principal one
  model.assembly.links[0].elements[0].I_PntE_L = 300.0 * Matrix3d::Identity();
  model.initial.omega_BN_B = {3.1, -0.7, 1.9};
  std::vector<Observation> samples(2);
  for (Observation& sample : samples) sample.omega_BN_B = model.initial.omega_BN_B;
  samples[0].q_BN = Quaterniond::Identity();
  samples[1].time = 1.0e7;
  const Eigen::Matrix<Real, 3, 1> omega = model.initial.omega_BN_B.cast<Real>();
  const Real angle = std::remainder(omega.norm() * 1.0e7L, 2.0L * std::numbers::pi_v<Real>);
  const Vector3d axis = model.initial.omega_BN_B.normalized();
  samples[1].q_BN = Quaterniond(Eigen::AngleAxisd(static_cast<double>(angle), axis));
  // 4e7 rad in extended precision are good to 4e-12 rad; in doubles they would be to 7e-9 rad.
  EXPECT_LT(deviations(ReferenceKind::kSpinUp, model, samples)[0].max, 1.0e-9);
}

TEST(Tolerances, AreThoseOfTheReferenceInTheUnitOfTheMetric) {
  Model model = spin_up_model();
  model.agreement.references.spin_up.attitude = std::numbers::pi / 180.0;
  model.agreement.references.torque_free.rate = 1.0;
  std::vector<Observation> samples(1);
  samples[0].q_BN = Quaterniond::Identity();
  samples[0].omega_BN_B.setZero();
  const auto found = deviations(ReferenceKind::kSpinUp, model, samples);
  EXPECT_NEAR(found[0].tolerance.value(), 1.0, 1.0e-15);  // [deg]
  EXPECT_EQ(found[1].tolerance, std::nullopt);
  model.agreement.references.kepler = {1.0, 2.0, {}, {}, {}};
  model.gravity.mu = kMu;
  std::vector<Observation> orbit(1);
  orbit[0].r_CN_N = kR0;
  orbit[0].v_CN_N = kV0;
  const auto path = deviations(ReferenceKind::kKepler, model, orbit);
  EXPECT_EQ(path[0].tolerance, 1.0);
  EXPECT_EQ(path[1].tolerance, 2.0);
}

TEST(SpinUp, SeesAnAttitudeErrorOfAFewNanoradians) {
  const Model model = spin_up_model();
  std::vector<Observation> samples(2);
  samples[0].q_BN = Quaterniond::Identity();
  samples[0].omega_BN_B = model.initial.omega_BN_B;
  samples[1].time = 100.0;
  samples[1].omega_BN_B = {0.0, 0.0, 0.03 + 0.4 / 600.0 * 100.0};
  const double angle = 0.03 * 100.0 + 0.4 / 1200.0 * 1.0e4;
  samples[1].q_BN = Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitZ())) *
                    Quaterniond(Eigen::AngleAxisd(3.0e-9, Vector3d::UnitX()));
  const auto found = deviations(ReferenceKind::kSpinUp, model, samples);
  EXPECT_NEAR(found[0].max, 3.0e-9 * 180.0 / std::numbers::pi, 1.0e-13);
  EXPECT_EQ(found[0].at, 100.0);
}

std::string spin_up_reason(const Model& model, GravityLaw law = GravityLaw::kNone) {
  return inapplicable(ReferenceKind::kSpinUp, model, law).value_or("");
}

TEST(SpinUp, AppliesToTheRigidHubWithATorqueAlongItsPrincipalRate) {
  EXPECT_EQ(spin_up_reason(spin_up_model()), "");
  EXPECT_EQ(spin_up_reason(toy_model()), "") << "at rest";
  EXPECT_EQ(spin_up_reason(spin_up_model(), GravityLaw::kSystemCom), "");
  EXPECT_EQ(spin_up_reason(spin_up_model(), GravityLaw::kBodyCom), "");
}

TEST(SpinUp, RefusesWhatTurnsTheVehicleOtherwise) {
  EXPECT_THAT(spin_up_reason(spin_up_model(), GravityLaw::kBodyGradient), HasSubstr("gravity"));

  Model jointed = spin_up_model();
  add_oscillator(jointed, "bob", 1.0);
  EXPECT_THAT(spin_up_reason(jointed), HasSubstr("joints"));

  Model wheeled = spin_up_model();
  wheeled.assembly.rotors.emplace_back().name = "rw";
  EXPECT_THAT(spin_up_reason(wheeled), HasSubstr("wheels"));

  Model tilted = spin_up_model();
  tilted.loads[0].torque_L[0] = Schedule::constant(1.0e-6);
  EXPECT_THAT(spin_up_reason(tilted), HasSubstr("not along the initial rate"));

  Model pushed = spin_up_model();
  pushed.loads[0].force_L[0] = Schedule::constant(1.0);
  pushed.loads[0].r_FL_L = Vector3d(0.0, 0.0, 0.1);
  EXPECT_THAT(spin_up_reason(pushed), HasSubstr("not along the initial rate"));

  Model skew = spin_up_model();
  skew.assembly.links[0].elements[0].I_PntE_L(0, 2) = 1.0;
  skew.assembly.links[0].elements[0].I_PntE_L(2, 0) = 1.0;
  EXPECT_THAT(spin_up_reason(skew), HasSubstr("principal axis"));
}

TEST(SpinUp, RefusesATorqueThatChangesDuringTheRun) {
  Model model = spin_up_model();
  model.loads[0].torque_L[2] = {{{0.0, 0.4}, {300.0, 0.0}}};
  EXPECT_THAT(spin_up_reason(model), HasSubstr("`push` changes"));
  model.loads[0].torque_L[2] = {{{0.0, 0.4}, {600.0, 0.0}}};
  EXPECT_EQ(spin_up_reason(model), "") << "constant until the end";
}

}  // namespace
}  // namespace twincraft
