// Claims about scsim as its user meets it: what it prints, writes and exits with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "runtime/report/netcdf.h"
#include "tests/support/run_program.h"

namespace twincraft {
namespace {

using nlohmann::json;
using test::ProgramResult;
using test::TemporaryFolder;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kQuickstart = TWINCRAFT_ROOT "/models/quickstart.yaml";

// One rigid body that is turned about a principal axis: everything is known in closed form.
const std::string kSpinner = R"(format: spacecraft/1
name: spinner
hub: {mass: 750, inertia: [900, 800, 600]}
loads:
  - {name: push, torque: [0, 0, 0.4]}
initial: {rate: [0, 0, 0.03]}
simulation: {integrator: rk4, step: 0.1, duration: 10, record: 1}
agreement: {attitude: 1.0e-9 deg, rate: 1.0e-12, position: 1 um}
references: [spin_up]
)";

class Scsim : public testing::Test {
 protected:
  ProgramResult run(std::vector<std::string> arguments, test::ProgramInput input = {}) {
    return test::run_program(TWINCRAFT_SCSIM, arguments, input);
  }
  /// The spinner with its report in the folder, and further arguments.
  ProgramResult run_spinner(std::vector<std::string> arguments, test::ProgramInput input = {}) {
    arguments.insert(arguments.begin(), {spinner, "-o", folder.path() + "/out"});
    return run(std::move(arguments), std::move(input));
  }
  json report() const { return json::parse(folder.read("out/report.json")); }
  json member() const { return report()["members"][0]; }

  TemporaryFolder folder;
  std::string spinner = folder.write("spinner.yaml", kSpinner);
};

TEST_F(Scsim, FindsTheQuickstartInAgreement) {
  const ProgramResult result = run({kQuickstart, "-o", folder.path() + "/out", "--trials", "1"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("11 DOF: hub, 3 wheels, 2 panels"));
  EXPECT_THAT(result.out, HasSubstr("the engines agree"));
  EXPECT_EQ(report()["verdict"], "agree");
  EXPECT_EQ(report()["complete"], true);
  EXPECT_EQ(report()["spec"]["degrees_of_freedom"], 11);
  for (const char* engine : {"bsm", "mujoco"}) {
    const json run = member()["engines"][engine];
    EXPECT_EQ(run["status"], "ok");
    EXPECT_EQ(run["steps"], 6000);
    EXPECT_EQ(run["evaluations"], 24000);
    EXPECT_EQ(run["t_end_s"], 120.0);
    // What a fourth-order step of 0.02 s leaves of them; a wrong sign anywhere leaves about one.
    EXPECT_LT(run["conservation"]["energy_relative"], 1.0e-6);
    EXPECT_LT(run["conservation"]["angular_momentum_relative"], 1.0e-8);
    EXPECT_LT(run["conservation"]["momentum_relative"], 1.0e-8);
  }
}

TEST_F(Scsim, FliesAPointMassThreeCentimetresOffKepler) {
  const ProgramResult result =
      run({TWINCRAFT_ROOT "/models/paper/orbit.yaml", "-o", folder.path() + "/out", "--no-timing"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("3 DOF: point mass"));
  EXPECT_EQ(report()["spec"]["degrees_of_freedom"], 3);
  EXPECT_FALSE(member()["agreement"].contains("attitude_deg"));
  EXPECT_FALSE(member()["agreement"].contains("rate_rad_s"));
  for (const char* engine : {"bsm", "mujoco"}) {
    const json run = member()["engines"][engine];
    EXPECT_EQ(run["final"]["q_BN"], (json{1.0, 0.0, 0.0, 0.0}));
    // The paper's: 3.04681e-2 m at 10 s, over two periods.
    EXPECT_NEAR(member()["references"]["kepler"][engine]["position_m"]["max"], 3.04681e-2, 1e-6);
    // What came in from outside is booked, so this is rounding and the step.
    EXPECT_LT(run["conservation"]["energy_relative"], 6.0e-11);
    EXPECT_EQ(run["conservation"]["angular_momentum_relative"], 0.0);
  }
  EXPECT_THAT(folder.read("out/bsm.csv"), HasSubstr(",1,0,0,0,0,0,0,"));
}

TEST_F(Scsim, WritesOneCsvPerEngineWithASampleEveryRecord) {
  ASSERT_EQ(run_spinner({"--no-timing"}).exit_code, 0);
  for (const char* file : {"out/bsm.csv", "out/mujoco.csv"}) {
    const std::string text = folder.read(file);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 12) << file;
    EXPECT_TRUE(text.starts_with("t [s],r_BN_N.x [m],")) << file;
  }
}

TEST_F(Scsim, HoldsEachEngineAgainstTheClosedForm) {
  ASSERT_EQ(run_spinner({"--no-timing"}).exit_code, 0);
  for (const char* engine : {"bsm", "mujoco"}) {
    const json reference = member()["references"]["spin_up"][engine];
    EXPECT_LT(reference["rate_rad_s"]["max"], 1.0e-14) << engine;
    EXPECT_LT(reference["attitude_deg"]["max"], 1.0e-6) << engine;
  }
  EXPECT_FALSE(member().contains("timing"));
}

TEST_F(Scsim, TimesByTheProtocol) {
  const ProgramResult result = run_spinner({"--trials", "3"});
  ASSERT_EQ(result.exit_code, 0);
  const json timing = member()["timing"];
  EXPECT_EQ(timing["protocol"], "warmup=1 trials=3 interleaved reversed");
  bool scattered = false;
  for (const char* engine : {"bsm", "mujoco"}) {
    std::vector<double> trials = timing[engine]["trials_s"];
    ASSERT_EQ(trials.size(), 3u);
    std::sort(trials.begin(), trials.end());
    EXPECT_GT(trials[0], 0.0);
    EXPECT_EQ(timing[engine]["median_s"], trials[1]);
    scattered = scattered || timing[engine]["spread_relative"] > 0.5;
  }
  // On a busy machine there may be no ratio, and then the report says why.
  ASSERT_EQ(timing.contains("ratio_bsm_over_mujoco"), !scattered);
  EXPECT_THAT(result.out, HasSubstr(scattered ? ": no ratio\n" : "x\n"));
  if (scattered) return;
  const double median_bsm = timing["bsm"]["median_s"], median_mujoco = timing["mujoco"]["median_s"];
  EXPECT_EQ(timing["ratio_bsm_over_mujoco"], median_bsm / median_mujoco);
}

TEST_F(Scsim, ExitsWithOneWhenAToleranceIsExceeded) {
  // A microgram on one side only is far more than rounding.
  const ProgramResult result =
      run({kQuickstart, "-o", folder.path() + "/out", "--no-timing", "--duration", "10 s",  //
           "--set", "engines.mujoco.compensate=false", "--set", "engines.mujoco.wheel_mass=1 g"});
  EXPECT_EQ(result.exit_code, 1) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("the engines disagree"));
  EXPECT_EQ(report()["verdict"], "disagree");
}

TEST_F(Scsim, TakesTheConvenienceFlagsForSpecPaths) {
  // One engine: two attitude charts do not agree to 1e-9 deg at second order.
  const ProgramResult result = run_spinner({"--no-timing", "--engine", "bsm", "--step", "0.2",
                                            "--integrator", "rk2", "--duration", "4 s"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(member()["settings"], (json{{"simulation.step", 0.2},
                                        {"simulation.integrator", "rk2"},
                                        {"simulation.duration", "4 s"}}));
  EXPECT_EQ(member()["engines"]["bsm"]["evaluations"], 40);
}

TEST_F(Scsim, RunsOneEngineAloneWithoutAVerdict) {
  const ProgramResult result = run_spinner({"--engine", "bsm", "--no-timing"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(report()["verdict"], "not_judged");
  EXPECT_EQ(member()["engines"]["mujoco"]["status"], "skipped");
  EXPECT_EQ(member()["agreement"], json::object());
  EXPECT_FALSE(folder.has("out/mujoco.csv"));
}

TEST_F(Scsim, ReadsASpecFromStandardInput) {
  const ProgramResult result = run({"-", "--no-timing"}, {kSpinner, {}});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("spinner   6 DOF: hub"));
}

TEST_F(Scsim, WritesNoFilesUnlessAsked) {
  ASSERT_EQ(run({spinner, "--no-timing"}).exit_code, 0);
  EXPECT_FALSE(folder.has("out"));
}

TEST_F(Scsim, IsSilentWhenQuiet) {
  const ProgramResult result = run_spinner({"--quiet", "--no-timing", "--progress", "always"});
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_TRUE(folder.has("out/report.json"));
}

TEST_F(Scsim, NamesTheFlagThatWasMeant) {
  const ProgramResult result = run_spinner({"--stepp", "0.1"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("unknown flag `--stepp`"));
  EXPECT_THAT(result.err, HasSubstr("did you mean `--step`?"));
}

TEST_F(Scsim, RefusesBadFlagValues) {
  EXPECT_EQ(run_spinner({"--engine", "mujocco"}).exit_code, 2);
  EXPECT_THAT(run_spinner({"--engine", "mujocco"}).err, HasSubstr("did you mean `mujoco`?"));
  EXPECT_EQ(run_spinner({"--trials", "-1"}).exit_code, 2);
  EXPECT_EQ(run_spinner({"--trials", "five"}).exit_code, 2);
  EXPECT_EQ(run({}).exit_code, 2);
}

TEST_F(Scsim, RefusesToWriteNowhere) {
  for (const std::string folder_name : {"", "-"}) {
    const ProgramResult result = run({spinner, "--no-timing", "-o", folder_name});
    EXPECT_EQ(result.exit_code, 2) << folder_name;
    EXPECT_THAT(result.err, HasSubstr("hint: ")) << folder_name;
    EXPECT_THAT(result.out, IsEmpty()) << folder_name;
  }
  EXPECT_EQ(run({"", "--no-timing"}).exit_code, 2);
  EXPECT_EQ(run({spinner, "--no-timing", "--step", ""}).exit_code, 2);
}

TEST_F(Scsim, RefusesTwoValuesForOneSetting) {
  for (const char* set : {"simulation.step=0.2", "simulation={step: 0.2, duration: 1}",
                          "simulation.step.per_period=10"}) {
    const ProgramResult result = run_spinner({"--step", "0.1", "--set", set});
    EXPECT_EQ(result.exit_code, 2) << set;
    EXPECT_THAT(result.err, HasSubstr("`--step` and `--set simulation")) << set;
  }
  EXPECT_EQ(
      run_spinner({"--step", "0.1", "--set", "simulation.duration=1", "--no-timing"}).exit_code, 0);
  EXPECT_EQ(run_spinner({"--set", "hub..mass=1"}).exit_code, 2);
}

TEST_F(Scsim, ExplainsCodesAndNamesTheCommandThatWasMeant) {
  const ProgramResult explained = run({"--explain", "SC2007"});
  EXPECT_EQ(explained.exit_code, 0) << explained.err;
  EXPECT_THAT(explained.out, HasSubstr("SC2007: not a quantity"));
  EXPECT_EQ(run({"--explain", "SC9999"}).exit_code, 2);
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"atribute"}, std::vector<std::string>{"atribute", spinner}}) {
    const ProgramResult misspelt = run(arguments);
    EXPECT_EQ(misspelt.exit_code, 2);
    EXPECT_THAT(misspelt.err, HasSubstr("did you mean `attribute`?"));
  }
}

TEST_F(Scsim, SaysWhatItWroteAndWhatTimingTakes) {
  if (!has_netcdf()) GTEST_SKIP() << "this build has no netCDF";
  const ProgramResult result = run_spinner({"--trials", "1", "--netcdf"});
  EXPECT_THAT(result.err, HasSubstr("wrote report.json, report.html, bsm.csv, bsm.nc, mujoco.csv, "
                                    "mujoco.nc to `" +
                                    folder.path()));
  EXPECT_THAT(result.out, HasSubstr("`--no-timing` skips them"));
  EXPECT_THAT(run({spinner, "--no-timing"}).err, IsEmpty());
}

TEST_F(Scsim, PrintsTimesThatRunsAtOtherStepsShare) {
  ASSERT_EQ(run_spinner({"--no-timing", "--set", "simulation.record=0.1"}).exit_code, 0);
  EXPECT_THAT(folder.read("out/bsm.csv"), HasSubstr("\n0.3,"));
  EXPECT_THAT(folder.read("out/bsm.csv"), Not(HasSubstr("0.30000000000000004")));
}

TEST_F(Scsim, HelpFitsOneScreen) {
  const ProgramResult result = run({"--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_LE(std::count(result.out.begin(), result.out.end(), '\n'), 40);
  EXPECT_THAT(result.out, HasSubstr("Example: scsim"));
  EXPECT_THAT(run({"--version"}).out, HasSubstr(TWINCRAFT_VERSION));
}

TEST_F(Scsim, ExitsWithOneForAFaultySpec) {
  const ProgramResult result = run_spinner({"--set", "hub.mass=-1"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("error[SC"));
  EXPECT_FALSE(folder.has("out/report.json"));
}

TEST_F(Scsim, ExitsWithOneForAReferenceThatDoesNotApply) {
  const ProgramResult result = run_spinner({"--set", "loads.push.torque=[0.2, -0.3, 0.4]"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("spin_up"));
}

TEST_F(Scsim, RefusesNetcdfInABuildWithoutIt) {
  if (has_netcdf()) GTEST_SKIP() << "this build has netCDF";
  const ProgramResult result = run_spinner({"--no-timing", "--netcdf"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("this build has no netCDF"));
  EXPECT_FALSE(folder.has("out"));
}

TEST_F(Scsim, WritesAPageToLookAtAndNetcdfWhenAskedTo) {
  if (!has_netcdf()) GTEST_SKIP() << "this build has no netCDF";
  EXPECT_EQ(run_spinner({"--no-timing"}).exit_code, 0);
  EXPECT_THAT(folder.read("out/report.html"), HasSubstr("<span id=\"verdict\">The engines agree<"));
  EXPECT_FALSE(folder.has("out/bsm.nc"));
  EXPECT_EQ(run_spinner({"--no-timing", "--netcdf"}).exit_code, 0);
  for (const char* file : {"out/bsm.nc", "out/mujoco.nc"})
    EXPECT_EQ(folder.read(file).substr(1, 3), "HDF") << file;
  EXPECT_EQ(run({spinner, "--netcdf"}).exit_code, 2);  // into which folder?
}

TEST_F(Scsim, ExitsWithThreeForAMissingFileOrAnUnwritableFolder) {
  EXPECT_EQ(run({folder.path() + "/missing.yaml"}).exit_code, 3);
  const ProgramResult result = run({spinner, "--no-timing", "-o", spinner + "/out"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("not a directory"));
  EXPECT_EQ(result.out, "");  // noticed before the run
}

TEST_F(Scsim, ExitsWithFourAndSaysWhereWhenNumbersBreakDown) {
  // A spring this stiff is far outside the stability of one step: rates grow without bound.
  const ProgramResult result =
      run({kQuickstart, "-o", folder.path() + "/out", "--no-timing", "--set",
           "panels.wing_p.stiffness=1.0e12", "--duration", "20 s"});
  EXPECT_EQ(result.exit_code, 4) << result.out << result.err;
  EXPECT_THAT(result.err, HasSubstr("bsm failed"));
  EXPECT_THAT(result.err, HasSubstr(" s"));
  EXPECT_EQ(report()["complete"], false);
  EXPECT_NE(report()["verdict"], "agree");
  EXPECT_EQ(member()["engines"]["bsm"]["status"], "failed");
  EXPECT_THAT(member()["engines"]["bsm"]["reason"].get<std::string>(), HasSubstr("t = "));
}

class Interrupted : public Scsim, public testing::WithParamInterface<std::pair<int, int>> {
 protected:
  /// A run of some hours.
  ProgramResult interrupt(const std::string& progress, const test::ProgramInput& input) {
    return run_spinner({"--duration", "1.0e9 s", "--set", "simulation.record=100 s",  //
                        "--progress", progress},
                       input);
  }
  test::ProgramInput after(const std::string& told) const {
    return test::signalled_after(told, GetParam().first);
  }
  /// For a run that tells nothing.
  test::ProgramInput after_work(double seconds) const {
    return {.while_running = [seconds](pid_t program) {
      test::await_work(program, seconds);
      kill(program, GetParam().first);
    }};
  }
};

TEST_P(Interrupted, WritesWhatItHasAndSaysItIsIncomplete) {
  // Both engines have come that far, which is ten samples and more.
  const ProgramResult result = interrupt("always", after(R"(both .* t = (\d{4}|\S+e\+\d+) s of)"));
  EXPECT_EQ(result.exit_code, GetParam().second) << result.err;
  EXPECT_EQ(report()["complete"], false);
  EXPECT_EQ(report()["verdict"], "interrupted");
  for (const char* name : {"bsm", "mujoco"}) {
    const json engine = member()["engines"][name];
    EXPECT_GT(engine["t_end_s"], 0.0);
    EXPECT_LT(engine["t_end_s"], 1.0e9);
    EXPECT_THAT(engine["reason"].get<std::string>(), HasSubstr("interrupted at t = "));
    EXPECT_TRUE(folder.has(std::string("out/") + name + ".csv"));
  }
  EXPECT_GT(member()["agreement"]["attitude_deg"]["at_s"], 0.0) << "both came some common way";
}

TEST_P(Interrupted, ShowsProgressOnlyOnATerminalOrWhenToldTo) {
  EXPECT_THAT(interrupt("always", after(R"(both    \[)")).err, HasSubstr("both    ["));
  // The bar comes after half a second, and two engines at once work for at most twice as long as
  // that lasts.
  EXPECT_THAT(interrupt("auto", after_work(2.0)).err, Not(HasSubstr("[")));
}

INSTANTIATE_TEST_SUITE_P(BySignal, Interrupted,
                         testing::Values(std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}));

}  // namespace
}  // namespace twincraft
