// Claims about studies as the user of scsim meets them: what is run, kept, written and concluded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/run_program.h"

namespace twincraft {
namespace {

using nlohmann::json;
using test::ProgramResult;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kModels = TWINCRAFT_ROOT "/models/paper/";

// Three axes of an unequal body: attitude in two charts differs by the integrator's error.
const std::string kTumbler = R"(format: spacecraft/1
name: tumbler
hub: {mass: 750, inertia: [900, 800, 600]}
loads:
  - {name: push, torque: [0.2, -0.3, 0.4]}
initial: {rate: [0.02, -0.01, 0.03]}
simulation: {integrator: rk4, step: 0.5, duration: 100, record: 10}
study:
  sweep:
    - {set: initial.rate, values: [[0.02, -0.01, 0.03], [0.04, 0, 0.03]]}
    - {set: simulation.step, values: [2, 1, 0.5]}
)";

class ScsimStudy : public testing::Test {
 protected:
  ProgramResult run(std::vector<std::string> arguments, test::ProgramInput input = {}) {
    arguments.insert(arguments.end(), {"-o", folder.path() + "/out"});
    return test::run_program(TWINCRAFT_SCSIM, arguments, input);
  }
  json report() const { return json::parse(folder.read("out/report.json")); }
  json timing_of(std::size_t member) const { return report()["members"][member]["timing"]; }

  TemporaryFolder folder;
};

TEST_F(ScsimStudy, SaysALineAsEachMemberEndsButNotIntoAPipe) {
  const std::string spec = kModels + "studies/orbit_steps.yaml";
  EXPECT_THAT(run({spec, "--no-timing"}).err, StartsWith("wrote report.json"));
  const ProgramResult told = run({spec, "--no-timing", "--progress", "always"});
  for (const char* line :
       {"1 of 5  step 40 s  agree\n", "2 of 5  step 20 s  agree\n", "5 of 5  step 2.5 s  agree\n"})
    EXPECT_THAT(told.err, HasSubstr(line));
  EXPECT_EQ(run({spec, "--no-timing", "--progress", "always", "--quiet"}).err, "");
}

TEST_F(ScsimStudy, FindsTheFourthOrderOfAnOrbit) {
  const ProgramResult result = run({kModels + "studies/orbit_steps.yaml", "--no-timing"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const json study = report();
  EXPECT_EQ(study["verdict"], "agree");
  EXPECT_EQ(study["complete"], true);
  ASSERT_EQ(study["members"].size(), 5u);
  EXPECT_EQ(study["members"][1]["settings"], (json{{"simulation.step", "20 s"}}));
  int judged = 0;
  for (const json& trend : study["studies"]["convergence"]) {
    if (trend["metric"] != "position_m") continue;
    ++judged;
    EXPECT_EQ(trend["reference"], "kepler");
    const std::vector<double> expected{4.25, 4.14, 4.08, 4.05};
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(trend["orders"][i].get<double>(), expected[i], 0.02) << i;
    EXPECT_NEAR(trend["errors"][0].get<double>(), 10.22, 0.01);
    EXPECT_NEAR(trend["errors"][4].get<double>(), 1.09e-4, 1e-6);
  }
  EXPECT_EQ(judged, 2);  // either engine
}

TEST_F(ScsimStudy, GivesTheSameMembersForAnyNumberOfJobs) {
  const std::string spec = folder.write("tumbler.yaml", kTumbler);
  ASSERT_EQ(run({spec, "--no-timing", "--jobs", "1"}).exit_code, 0);
  const json one = report();
  ASSERT_EQ(run({spec, "--no-timing", "--jobs", "4"}).exit_code, 0);
  ASSERT_EQ(one["members"].size(), 6u);
  EXPECT_EQ(one["members"].dump(), report()["members"].dump());
  EXPECT_EQ(one["studies"].dump(), report()["studies"].dump());
}

TEST_F(ScsimStudy, WritesFurtherMembersIntoFoldersOfTheirOwn) {
  ASSERT_EQ(run({folder.write("tumbler.yaml", kTumbler), "--no-timing"}).exit_code, 0);
  EXPECT_TRUE(folder.has("out/bsm.csv"));
  EXPECT_TRUE(folder.has("out/0001/mujoco.csv"));
  EXPECT_TRUE(folder.has("out/0005/bsm.csv"));
  EXPECT_FALSE(folder.has("out/0006"));
}

TEST_F(ScsimStudy, SeparatesTheOrdersOfAGrid) {
  const ProgramResult result = run({folder.write("tumbler.yaml", kTumbler), "--no-timing"});
  EXPECT_THAT(result.out, HasSubstr("6 of 6 members"));
  int trends = 0;
  const json study = report();
  for (const json& trend : study["studies"]["convergence"]) {
    if (trend["metric"] != "attitude_deg") continue;
    ++trends;
    for (const json& order : trend["orders"]) EXPECT_NEAR(order.get<double>(), 4.0, 0.3);
    EXPECT_EQ(trend["settings"].size(), 1u);
  }
  EXPECT_EQ(trends, 2);
}

TEST_F(ScsimStudy, KeepsAFailureToTheMemberThatHasIt) {
  // Euler's method on a stiff spring leaves the numbers at a step of 0.5 s and not at 1 ms.
  const std::string spec = folder.write("spring.yaml", R"(format: spacecraft/1
name: spring
hub: {mass: 100, inertia: [100, 100, 100]}
panels:
  - {name: wing, hinge: {position: [1, 0, 0], axis: [0, 1, 0], outboard: [1, 0, 0]},
     mass: 10, length: 1, inertia: {shape: bar}, stiffness: 1.0e+6, angle: 1 deg}
simulation: {integrator: euler, step: 0.5, duration: 200}
study: {sweep: [{set: simulation, values: [
  {integrator: rk4, step: 1 ms, duration: 0.1},
  {integrator: euler, step: 0.5, duration: 500},
  {integrator: rk4, step: 2 ms, duration: 0.1}]}]}
)");
  const ProgramResult result = run({spec, "--no-timing"});
  EXPECT_EQ(result.exit_code, 4) << result.out << result.err;
  EXPECT_THAT(result.err, HasSubstr("member 1: "));
  const json members = report()["members"];
  ASSERT_EQ(members.size(), 3u);
  EXPECT_EQ(members[1]["engines"]["bsm"]["status"], "failed");
  EXPECT_FALSE(members[1]["engines"]["bsm"]["reason"].get<std::string>().empty());
  for (const int sound : {0, 2}) EXPECT_EQ(members[sound]["engines"]["bsm"]["status"], "ok");
}

TEST_F(ScsimStudy, KeepsWhatWasDoneBeforeAnInterrupt) {
  const std::string spec = folder.write("tumbler.yaml", kTumbler);
  // One short member, then one that nobody waits for.
  const ProgramResult result =
      run({spec, "--no-timing", "--jobs", "1", "--progress", "always", "--set", "loads=null",
           "--set", "study={sweep: [{set: simulation.duration, values: [10, 1.0e+8]}]}"},
          test::signalled_after("1 of 2  ", SIGINT));
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_EQ(report()["complete"], false);
  ASSERT_GE(report()["members"].size(), 1u);
  EXPECT_EQ(report()["members"][0]["engines"]["bsm"]["t_end_s"], 10.0);
}

TEST_F(ScsimStudy, TimesMembersAndTellsHowTheirCostGrows) {
  const ProgramResult result =
      run({kModels + "flex_panels.yaml", "--trials", "1", "--duration", "0.2 s", "--set",
           "study={sweep: [{set: panels.*.segments, values: [2, 8]}]}"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const json scaling = report()["studies"]["scaling"];
  ASSERT_EQ(scaling.size(), 2u);
  EXPECT_EQ(scaling[0]["engine"], "bsm");
  EXPECT_EQ(scaling[0]["degrees_of_freedom"], (json{10, 22}));
  // Which exponent that is depends on what else the machine does, so it may have either sign.
  for (const json& trend : scaling) {
    const std::vector<double> times = trend["us_per_step"];
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_EQ(times.at(i), timing_of(i)[trend["engine"].get<std::string>()]["us_per_step"]);
    EXPECT_GT(times[0], 0.0);
    EXPECT_NEAR(trend["exponents"][0].get<double>(),
                std::log(times[1] / times[0]) / std::log(22.0 / 10.0), 1.0e-12);
  }
  EXPECT_THAT(result.out, HasSubstr("exponent in the coordinates"));
}

TEST_F(ScsimStudy, FindsDisagreementInProportionToTheTokenMass) {
  const ProgramResult result =
      run({kModels + "rw_panels.yaml", "--no-timing", "--duration", "20 s",  //
           "--set", "engines.mujoco.compensate=false", "--set",
           "study={sweep: [{set: engines.mujoco.wheel_mass, values: [1.0e-4, 1.0e-5]}]}"});
  EXPECT_EQ(result.exit_code, 1) << result.err;  // far above the tolerances
  int found = 0;
  const json study = report();
  for (const json& trend : study["studies"]["slopes"]) {
    if (trend["metric"] != "attitude_deg") continue;
    ++found;
    EXPECT_NEAR(trend["slopes"][0].get<double>(), 1.0, 0.01);
  }
  EXPECT_EQ(found, 1);
}

TEST_F(ScsimStudy, ShowsWhatAnOrbitDoesToTheRotationOfOneEngine) {
  const ProgramResult result = run({kModels + "studies/torque_motion.yaml", "--no-timing"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("MuJoCo by itself"));
  const json members = report()["members"];
  ASSERT_EQ(members.size(), 3u);
  EXPECT_FALSE(members[0].contains("against"));
  for (const int i : {1, 2}) {
    EXPECT_EQ(members[i]["against"]["member"], 0);
    EXPECT_EQ(members[i]["against"]["bsm"]["attitude_deg"]["max"], 0.0);
    EXPECT_GT(members[i]["against"]["bsm"]["position_m"]["max"], 7.0e6);
  }
  // A force at the centre of mass turns nothing; what rounding of m v^2 turns is some 1e-4 deg.
  EXPECT_EQ(members[1]["against"]["mujoco"]["attitude_deg"]["max"], 0.0);
  EXPECT_GT(members[2]["against"]["mujoco"]["attitude_deg"]["max"], 1.0e-6);
  EXPECT_LT(members[2]["against"]["mujoco"]["attitude_deg"]["max"], 1.0e-2);
}

TEST_F(ScsimStudy, SaysThatThereIsNoBaselineWhereItFailed) {
  // The first stiffness is far outside of Euler's stability, the second inside.
  const std::string spec = folder.write("fails.yaml", R"(format: spacecraft/1
name: fails
hub: {mass: 100, inertia: [100, 100, 100]}
panels:
  - {name: wing, hinge: {position: [1, 0, 0], axis: [0, 1, 0], outboard: [1, 0, 0]},
     mass: 10, length: 1, inertia: {shape: bar}, stiffness: 1.0e+6, angle: 1 deg}
simulation: {integrator: euler, step: 0.5, duration: 500, resolution: report}
study:
  compare: panels.wing.stiffness
  sweep: [{set: panels.wing.stiffness, values: [1.0e+6, 1.0e-4]}]
)");
  const ProgramResult result = run({spec, "--no-timing"});
  EXPECT_EQ(result.exit_code, 4) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("no baseline"));
  const json against = report()["members"][1]["against"];
  EXPECT_EQ(against["failed_baselines"], (json{"bsm", "mujoco"}));
  EXPECT_FALSE(against.contains("bsm"));
}

TEST_F(ScsimStudy, HoldsEveryGroupOfAGridAgainstItsOwnFirst) {
  const std::string spec = folder.write("tumbler.yaml", kTumbler + "  compare: simulation.step\n");
  ASSERT_EQ(run({spec, "--no-timing", "--jobs", "3"}).exit_code, 0);
  const json members = report()["members"];
  const std::vector<int> baselines{0, 0, 0, 3, 3, 3};
  for (std::size_t i = 0; i < members.size(); ++i) {
    ASSERT_EQ(members[i].contains("against"), i % 3 != 0) << i;
    if (i % 3 == 0) continue;
    EXPECT_EQ(members[i]["against"]["member"], baselines[i]);
    EXPECT_EQ(members[i]["against"]["bsm"]["same_sample_times"], true);
    EXPECT_GT(members[i]["against"]["bsm"]["attitude_deg"]["max"], 1.0e-6);
  }
}

/// The columns of a trajectory from the attitude to the centre of mass, line by line.
std::vector<std::vector<double>> hub_of(const std::string& csv) {
  std::vector<std::vector<double>> lines;
  std::istringstream text(csv);
  std::string line, cell;
  std::getline(text, line);  // names
  while (std::getline(text, line)) {
    std::istringstream cells(line);
    lines.emplace_back();
    while (lines.back().size() < 20 && std::getline(cells, cell, ','))
      lines.back().push_back(std::stod(cell));
  }
  return lines;
}

TEST_F(ScsimStudy, FliesTheArraysAlikeAsPanelsAndAsBodies) {
  for (const std::string n : {"1", "2", "4", "8"}) {
    ASSERT_EQ(run({kModels + "flex_panels.yaml", "--no-timing", "--set",  //
                   "panels.*.segments=" + n})
                  .exit_code,
              0);
    const auto panels = hub_of(folder.read("out/bsm.csv"));
    ASSERT_EQ(run({kModels + "flex_bodies/0" + n + ".yaml", "--no-timing"}).exit_code, 0);
    const auto bodies = hub_of(folder.read("out/bsm.csv"));
    ASSERT_EQ(panels.size(), bodies.size());
    ASSERT_GT(panels.size(), 500u);
    for (std::size_t i = 0; i < panels.size(); ++i) {
      ASSERT_EQ(panels[i].size(), 20u);
      EXPECT_EQ(panels[i][0], bodies[i][0]);  // the generated step is that of the rule
      // 6e-13 deg of attitude, the paper's own between its two analytic effectors, is 5e-15 of a
      // quaternion; all else is smaller here than one.
      for (std::size_t j = 1; j < 20; ++j) EXPECT_NEAR(panels[i][j], bodies[i][j], 5.0e-15);
    }
  }
}

TEST_F(ScsimStudy, MeasuresWorkAgainstPrecision) {
  const ProgramResult result =
      run({kModels + "rw_panels.yaml", "--trials", "1", "--duration", "5 s", "--set",
           "study={work_precision: {configurations: ["
           "{integrator: rk4, set: simulation.step, values: [0.1, 0.05]},"
           "{integrator: rkf78, step: 0.5, set: simulation.tolerance, values: [1.0e-8]}],"
           "reference: {step: 0.5}}}"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(report()["verdict"], "not_judged");
  EXPECT_EQ(report()["members"].size(), 5u);
  for (const char* engine : {"bsm", "mujoco"}) {
    const json work = report()["studies"]["work_precision"][engine];
    EXPECT_LT(work["floor"]["attitude_deg"], 1.0e-8);
    const json& runs = work["configurations"];
    ASSERT_EQ(runs.size(), 3u);
    EXPECT_NEAR(runs[0]["attitude_deg"].get<double>() / runs[1]["attitude_deg"].get<double>(), 16.0,
                6.0);
    EXPECT_GT(runs[0]["median_s"], 0.0);
    EXPECT_EQ(runs[0]["evaluations"], 200);
  }
  EXPECT_THAT(result.out, HasSubstr("BSM is faster in"));
}

constexpr const char* kOutputs = R"(  outputs:
    - {name: peak, of: omega_BN_B, reduce: max_norm, require: {below: 60 mrad/s}}
    - {name: crossing, of: omega_BN_B.x, reduce: first_crossing, level: 35 mrad/s}
)";

TEST_F(ScsimStudy, ReducesEveryMemberToTheOutputsThatItAsksFor) {
  const ProgramResult result =
      run({folder.write("tumbler.yaml", kTumbler + kOutputs), "--no-timing"});
  EXPECT_EQ(result.exit_code, 1);  // a faster start breaks the requirement
  EXPECT_THAT(result.out, HasSubstr("BROKEN"));
  const json found = report();
  for (const json& member : found["members"]) {
    const json& peak = member["outputs"]["peak"];
    EXPECT_EQ(peak["unit"], "rad/s");
    EXPECT_EQ(peak["below"], 0.06);
    EXPECT_EQ(peak["pass"], peak["value"] < 0.06);
    EXPECT_TRUE(member["outputs"]["crossing"].contains("value"));
    EXPECT_FALSE(member["outputs"]["crossing"].contains("pass"));
  }
  EXPECT_EQ(found["verdict"], "not_judged");  // that is of agreement
}

}  // namespace
}  // namespace twincraft
