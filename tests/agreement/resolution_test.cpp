// Vehicles whose motion a step can destroy, and what must be said of each step. Both engines agree
// on all of them: they share the step. The errors in the names were measured against rkf78 at
// 1e-12.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/support/run_program.h"

namespace twincraft {
namespace {

using nlohmann::json;
using test::ProgramResult;
using test::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

const std::string kHub = "hub: {mass: 250 kg, inertia: [40, 50, 60]}\n";
const std::string kPlate = "inertia: {shape: plate, width: 0.6 m, thickness: 2 cm}";

/// A panel of 3 kg and 1.5 m on the hub's side where `side` points.
std::string panel(const std::string& name, int side, const std::string& more) {
  return fmt::format(
      "  - {{name: {}, hinge: {{position: [{}, 0, 0], axis: [0, 1, 0], outboard: [{}, 0, 0]}}, "
      "mass: 3 kg, length: 1.5 m, {}, {}}}\n",
      name, 0.6 * side, side, kPlate, more);
}

struct Vehicle {
  std::string name;
  std::string text;
  double duration;  // [s]
};

const std::string kSpring = kHub + "panels:\n" + panel("w", 1, "stiffness: 250, angle: 2 deg");
const std::string kPulse = kHub + "panels:\n" + panel("w", 1, "stiffness: 250") +
                           "loads: [{name: l, torque: [0, 3, 0], during: [[20 s, 21 s]]}]\n";
const std::string kDamper =
    kHub + "panels:\n" + panel("w", 1, "stiffness: 3, damping: 60, angle: 4 deg");
const std::string kStiffBesideSoft = kHub + "panels:\n" +
                                     panel("s", 1, "stiffness: 0.4, damping: 0.01, angle: 6 deg") +
                                     panel("k", -1, "stiffness: 2500, damping: 0.5, angle: 0 deg");
const std::string kSpringInOrbit =
    kHub +
    "slosh: [{name: p, type: particle, mass: 20 kg, axis: [1, 0, 0], position: [0, 0.3, 0.2], "
    "stiffness: 400, displacement: 3 cm}]\n"
    "environment: {gravity: {mu: 3.986004418e14}}\n"
    "initial: {orbit: {semi_major_axis: 7000 km, eccentricity: 0.001, inclination: 40 deg, "
    "raan: 0, argument_of_periapsis: 0, true_anomaly: 0}}\n";
const std::string kPendulum =
    "hub: {mass: 400 kg, inertia: [150, 220, 210]}\n"
    "slosh: [{name: bob, type: pendulum, mass: 80 kg, length: 0.25 m, position: [0, 0, 0.4], "
    "rest: [0, 0, -1], reference: [1, 0, 0], angles: [3 deg, -2 deg]}]\n"
    "thrusters: [{name: e, position: [0, 0, -1.2], direction: [0, 0, 1], thrust: 5000 N, "
    "during: [[0 s, 20 s]]}]\n";
const std::string kNutation =
    "hub: {mass: 30 kg, inertia: [0.9, 0.8, 1]}\n"
    "wheels: [{name: rw, axis: [0, 0, 1], spin_inertia: 0.01, transverse_inertia: 0.006, "
    "speed: 5000 rpm}]\n"
    "initial: {rate: [0.02, -0.01, 0]}\n";
const std::string kTumbler =
    "hub: {mass: 80 kg, inertia: [8, 9, 12]}\ninitial: {rate: [0.3, 0.1, 5]}\n";
const std::string kEmptyingTank =
    "hub: {mass: 200 kg, inertia: [90, 120, 110]}\n"
    "tanks: [{name: t, position: [0, 0, -0.5], shape: {sphere: {radius: 0.4 m}}, "
    "propellant: 60 kg}]\n"
    "slosh: [{name: s, type: particle, tank: t, mass: 10 kg, axis: [1, 0, 0], stiffness: 4, "
    "damping: 1.5, displacement: 1 cm}]\n"
    "thrusters: [{name: e, position: [0, 0, -1], direction: [0, 0, 1], thrust: 200 N, "
    "isp: 220 s, tank: t, during: [[0 s, 640 s]]}]\n";
const std::string kAtRest = kHub + "panels:\n" + panel("w", 1, "stiffness: 250, damping: 1");
const std::string kSpinningPanels =
    kHub + "panels:\n" + panel("a", 1, "stiffness: 0.5, angle: 2 deg") +
    panel("b", -1, "stiffness: 0.5, angle: 2 deg") + "initial: {rate: [0, 0, 4]}\n";
const std::string kLongOrbit =
    "hub: {mass: 100 kg, inertia: [10, 12, 15]}\n"
    "environment: {gravity: {mu: 3.986004418e14}}\n"
    "initial: {orbit: {semi_major_axis: 70000 km, eccentricity: 0.9, inclination: 30 deg, "
    "raan: 0, argument_of_periapsis: 0, true_anomaly: 180 deg}}\n";

const Vehicle kVehicles[] = {
    {"Spring", kSpring, 30},
    {"Pulse", kPulse, 30},
    {"Damper", kDamper, 60},
    {"StiffBesideSoft", kStiffBesideSoft, 120},
    {"InOrbit", kSpringInOrbit, 100},
    {"Pendulum", kPendulum, 30},
    {"Nutation", kNutation, 60},
    {"Tumbler", kTumbler, 60},
    {"EmptyingTank", kEmptyingTank, 640},
    {"AtRest", kAtRest, 20},
    {"SpinningPanels", kSpinningPanels, 60},
    {"LongOrbit", kLongOrbit, 552000},
};

const Vehicle& vehicle(const std::string& name) {
  for (const Vehicle& one : kVehicles)
    if (one.name == name) return one;
  throw std::out_of_range(name);
}

struct Case {
  std::string vehicle;
  std::string method;
  std::string step;  // [s]
  std::string verdict;
  std::string coordinate;  // the fastest; empty: not asked
  double rate = 0.0;       // [rad/s]
};

void PrintTo(const Case& one, std::ostream* out) {
  *out << one.vehicle << " " << one.method << " at " << one.step << " s";
}

/// Runs of one spec, into one folder.
class Runs {
 protected:
  json run(const std::string& spec, std::vector<std::string> more = {}) {
    const std::string file = folder.write("spec.yaml", spec);
    more.insert(more.begin(), {file, "-o", folder.path() + "/out", "--no-timing"});
    last = test::run_program(TWINCRAFT_SCSIM, more);
    return json::parse(folder.read("out/report.json"));
  }
  TemporaryFolder folder;
  ProgramResult last;
};

class Resolution : public Runs, public testing::TestWithParam<Case> {
 protected:
  static std::string text_of(const Case& one) {
    const Vehicle& subject = vehicle(one.vehicle);
    return fmt::format(
        "format: spacecraft/1\nname: {}\n{}simulation: {{integrator: {}, step: {} s, "
        "duration: {} s{}}}\nengines: {{bsm: {{attitude: quaternion}}}}\n"
        "agreement: {{attitude: 1.0e-4 deg, joint: 1.0e-4 deg}}\n",
        subject.name, subject.text, one.method, one.step, subject.duration,
        subject.name == "LongOrbit" ? ", mode: translation" : "");
  }
};

int exit_code(const std::string& verdict) {
  if (verdict == "failed") return 4;
  return verdict == "unresolved" ? 1 : 0;
}

TEST_P(Resolution, IsJudged) {
  const Case& one = GetParam();
  const json report = run(text_of(one));
  const json& member = report["members"][0];
  const json& resolution = member["resolution"];
  if (one.verdict == "resolved") {
    EXPECT_EQ(resolution["resolved"], true) << last.out;
    EXPECT_TRUE(resolution["rule"].is_null());
    EXPECT_EQ(last.exit_code, 0) << last.out;
  } else {
    EXPECT_EQ(report["verdict"], one.verdict) << last.out;
    EXPECT_EQ(member["verdict"], one.verdict);
    EXPECT_EQ(last.exit_code, exit_code(one.verdict)) << last.out << last.err;
    EXPECT_EQ(resolution["resolved"], false);
    EXPECT_THAT(last.out, HasSubstr(one.verdict + ": "));
    EXPECT_THAT(last.out, Not(HasSubstr(" ok\n")));
  }
  if (one.coordinate.empty()) return;
  EXPECT_EQ(resolution["fastest"]["coordinate"], one.coordinate);
  EXPECT_NEAR(resolution["fastest"]["rate_rad_s"].get<double>(), one.rate, 5.0e-3 * one.rate);
}

TEST_P(Resolution, AdvisesAStepThatResolves) {
  const Case& one = GetParam();
  if (one.verdict == "resolved") return;
  const json before = run(text_of(one))["members"][0]["resolution"];
  ASSERT_TRUE(before["advised_step_s"].is_number()) << last.out;
  const double advised = before["advised_step_s"];
  EXPECT_LT(advised, std::stod(one.step));
#ifdef TWINCRAFT_SANITIZED
  // Millions of steps are minutes there, and the same code as thousands.
  if (vehicle(one.vehicle).duration / advised > 2.0e5) GTEST_SKIP();
#endif
  const json after = run(text_of(one), {"--set", fmt::format("simulation.step={}", advised)});
  EXPECT_EQ(after["members"][0]["resolution"]["resolved"], true) << last.out;
}

// A member of a campaign that one engine flies is told apart by bounds, and judged where these do
// not settle it: its row says what a run says.
TEST_P(Resolution, IsJudgedOfAMemberOfACampaignAsOfARun) {
  const Case& one = GetParam();
  const std::string campaign =
      "campaign: {members: 2, dispersions: [{set: hub.mass, choice: {values: [100 %]}}]}\n";
  const json report = run(text_of(one) + campaign, {"--engine", "bsm"});
  EXPECT_EQ(report["verdict"], one.verdict == "resolved" ? "not_judged" : one.verdict);
  EXPECT_EQ(last.exit_code, exit_code(one.verdict)) << last.out;
}

class Failure : public Runs, public testing::Test {
 protected:
  /// A tank that is drained but for a little, while its slosh keeps spring and damper.
  static std::string draining(std::string_view step, std::string_view end, double damping) {
    return fmt::format(
        "format: spacecraft/1\nname: drain\nhub: {{mass: 100 kg, inertia: [10, 12, 15]}}\n"
        "tanks: [{{name: t, shape: {{sphere: {{radius: 0.4}}}}, propellant: 20 kg}}]\n"
        "thrusters: [{{name: th, tank: t, position: [0, 0, -1], direction: [0, 0, 1], "
        "thrust: 2 kN, isp: 100 s, during: [[0 s, {} s]]}}]\n"
        "slosh: [{{name: s, type: particle, tank: t, mass: 2 kg, position: [0.1, 0, 0], "
        "axis: [1, 0, 0], stiffness: 2, damping: {}, displacement: 0.05}}]\n"
        "initial: {{rate: [0.01, 0.02, 0.03]}}\n"
        "simulation: {{integrator: rk4, step: {} s, duration: 20 s}}\n"
        "agreement: {{attitude: 1.0e-6 deg}}\n",
        end, damping, step);
  }
};

// At 9.806 s 1.3 g of 20 kg are left, of the 2 kg that slosh 0.133 g: s^2 + 754 s + 15083 = 0, so
// that the damper settles at 734 1/s, which rk4 follows below 2.785 / 734 s.
TEST_F(Failure, NamesTheSloshOfADrainedTankAtAnyStep) {
  for (const char* step : {"0.1", "0.02"}) {
    const json resolution = run(draining(step, "9.806", 0.1))["members"][0]["resolution"];
    EXPECT_EQ(last.exit_code, 4) << last.out;
    EXPECT_EQ(resolution["worst"]["coordinate"], "s");
    EXPECT_THAT(resolution["reasons"][0], HasSubstr("s is damped at 734 1/s at t = 9.806 s: rk4 is "
                                                    "stable below 0.0038 s, the step is"));
    EXPECT_EQ(resolution["advised_step_s"], 1.0e-3) << step;
  }
  const json report = run(draining("0.001", "9.806", 0.1));
  EXPECT_EQ(report["verdict"], "agree") << last.out;
}

// At 9.8066499 s the tank is empty to its last digits.
TEST_F(Failure, SaysWhereNoStepResolvesATankThatEmpties) {
  const json resolution = run(draining("0.1", "9.8066499", 1.0e4))["members"][0]["resolution"];
  EXPECT_EQ(last.exit_code, 4) << last.out;
  EXPECT_THAT(resolution["reasons"][0], HasSubstr(". No step of use resolves a tank that empties"));
  EXPECT_TRUE(resolution["advised_step_s"].is_null());
}

TEST_F(Failure, SaysWhereNoStepIsOfUse) {
  const auto spring = [](std::string_view integrator, std::string_view joint, double duration) {
    return fmt::format(
        "format: spacecraft/1\nname: stiff\nhub: {{mass: 100 kg, inertia: [10, 12, 15]}}\n"
        "bodies: [{{name: b, joint: {{type: revolute, axis: [1, 0, 0], angle: 0.1, {}}}, mass: 5, "
        "inertia: [1, 1, 1]}}]\n"
        "simulation: {{integrator: {}, step: 0.1 s, duration: {} s}}\n",
        joint, integrator, duration);
  };
  const auto judged = [&](const std::string& spec) {
    return run(spec)["members"][0]["resolution"];
  };
  const json stiff = judged(spring("rk4", "stiffness: 1.0e30, damping: 10", 20.0));
  EXPECT_EQ(last.exit_code, 4) << last.out;
  EXPECT_THAT(stiff["reasons"][0], HasSubstr(". No step of use resolves it: the run would take "
                                             "more than 1e+09 steps"));
  EXPECT_TRUE(stiff["advised_step_s"].is_null());
  // Euler needs steps that rk4 does not.
  const json by_euler = judged(spring("euler", "stiffness: 100", 1.0e5));
  EXPECT_THAT(by_euler["reasons"][0], HasSubstr("--integrator rk4 --step"));
  EXPECT_TRUE(by_euler["advised_step_s"].is_null());
}

TEST_F(Failure, NamesThePoleOfAPendulum) {
  const json resolution = run(R"(format: spacecraft/1
name: pole
hub: {mass: 500 kg, inertia: [200, 220, 250]}
slosh: [{name: bob, type: pendulum, mass: 20 kg, length: 0.3 m, rest: [0, 0, -1], reference: [0, 1, 0],
         angles: [0.2, 0.6], rates: [0.1, 1.0]}]
simulation: {integrator: rk4, step: 0.1 s, duration: 20 s}
)")["members"][0]["resolution"];
  EXPECT_EQ(last.exit_code, 4) << last.out;
  EXPECT_EQ(resolution["worst"]["coordinate"], "bob.theta");
  EXPECT_THAT(resolution["reasons"][0],
              HasSubstr("near its pole, where phi means nothing: choose another `reference`"));
}

INSTANTIATE_TEST_SUITE_P(
    Vehicles, Resolution,
    testing::Values(Case{"Spring", "rk4", "0.1", "unresolved", "w.1", 11.1716},
                    Case{"Spring", "rk4", "0.05", "unresolved", "w.1", 11.1716},
                    Case{"Spring", "rk4", "0.02", "resolved", "w.1", 11.1716},
                    Case{"Spring", "rk2", "0.01", "unresolved", "", 0.0},
                    Case{"Spring", "rk2", "0.001", "resolved", "", 0.0},
                    Case{"Spring", "euler", "0.001", "unresolved", "", 0.0},
                    Case{"Pulse", "rk4", "0.2", "unresolved", "w.1", 11.1716},
                    Case{"Pulse", "rk4", "0.05", "unresolved", "w.1", 11.1716},
                    Case{"Pulse", "rk4", "0.01", "resolved", "w.1", 11.1716},
                    Case{"Damper", "rk4", "0.1", "unresolved", "w.1", 29.8975},
                    Case{"Damper", "rk4", "0.09", "unresolved", "w.1", 29.8975},
                    Case{"Damper", "rk4", "0.05", "resolved", "w.1", 29.8975},
                    Case{"Damper", "euler", "0.05", "resolved", "", 0.0},
                    Case{"StiffBesideSoft", "rk4", "0.1", "failed", "k.1", 35.3216},
                    Case{"StiffBesideSoft", "rk4", "0.05", "unresolved", "k.1", 35.3216},
                    Case{"StiffBesideSoft", "rk4", "0.02", "unresolved", "k.1", 35.3216},
                    Case{"StiffBesideSoft", "rk4", "0.005", "resolved", "k.1", 35.3216},
                    Case{"InOrbit", "rk4", "0.2", "unresolved", "p", 4.7455},
                    Case{"InOrbit", "rk4", "0.05", "resolved", "p", 4.7455},
                    Case{"InOrbit", "rk4", "0.02", "resolved", "p", 4.7455},
                    Case{"Pendulum", "rk4", "0.4", "failed", "bob.theta", 7.155},
                    Case{"Pendulum", "rk4", "0.2", "unresolved", "", 0.0},
                    Case{"Pendulum", "rk4", "0.1", "unresolved", "bob.theta", 7.155},
                    Case{"Pendulum", "rk4", "0.02", "resolved", "bob.theta", 7.155},
                    Case{"Nutation", "rk4", "0.5", "failed", "", 0.0},
                    Case{"Nutation", "rk4", "0.3", "unresolved", "", 0.0},
                    Case{"Nutation", "rk4", "0.1", "unresolved", "rotation", 6.1273},
                    Case{"Nutation", "rk4", "0.02", "resolved", "rotation", 6.1273},
                    Case{"Tumbler", "rk4", "0.5", "unresolved", "", 0.0},
                    Case{"Tumbler", "rk4", "0.2", "unresolved", "", 0.0},
                    Case{"Tumbler", "rk4", "0.1", "resolved", "", 0.0},
                    Case{"Tumbler", "rk2", "0.01", "unresolved", "", 0.0},
                    Case{"Tumbler", "rk2", "0.001", "resolved", "", 0.0},
                    Case{"EmptyingTank", "rk4", "0.5", "unresolved", "s", 9.752},
                    Case{"EmptyingTank", "rk4", "0.4", "unresolved", "s", 9.752},
                    Case{"EmptyingTank", "rk4", "0.2", "resolved", "s", 9.752},
                    Case{"AtRest", "rk4", "0.3", "unresolved", "w.1", 11.17},
                    Case{"AtRest", "rk4", "0.1", "resolved", "w.1", 11.17},
                    Case{"SpinningPanels", "rk4", "0.3", "unresolved", "", 0.0},
                    Case{"SpinningPanels", "rk4", "0.1", "unresolved", "", 0.0},
                    Case{"SpinningPanels", "rk4", "0.05", "resolved", "", 0.0},
                    Case{"SpinningPanels", "rk4", "0.02", "resolved", "", 0.0},
                    Case{"LongOrbit", "rk4", "30", "resolved", "", 0.0},
                    Case{"LongOrbit", "rk4", "60", "resolved", "", 0.0},
                    Case{"LongOrbit", "rk4", "120", "unresolved", "", 0.0},
                    Case{"LongOrbit", "rk4", "240", "unresolved", "", 0.0}),
    [](const testing::TestParamInfo<Case>& one) {
      std::string name = one.param.vehicle + "_" + one.param.method + "_" + one.param.step;
      std::ranges::replace(name, '.', '_');
      return name;
    });

}  // namespace
}  // namespace twincraft
