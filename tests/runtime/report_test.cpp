// Claims about the three forms of a report, on results written by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "runtime/report/csv.h"
#include "runtime/report/json.h"
#include "runtime/report/table.h"
#include "runtime/report/words.h"
#include "tests/runtime/handmade.h"
#include "tools/programs/progress.h"

namespace twincraft {
namespace {

using nlohmann::json;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

EngineRun engine_run(const std::string& name, const Model& model) {
  EngineRun run;
  run.name = name;
  run.trajectory = test::standstill(model);
  run.conservation = {1.0e-13, 2.0e-14, 3.0e-15};
  return run;
}

/// Two complete runs that agree, one reference, five trials.
Report sound_report() {
  ReportedMember member;
  member.bundle.model = test::model_of_every_kind();
  Model& model = member.bundle.model;
  model.agreement.rate = 1.0e-12;
  member.bundle.spec_file = "spec.yaml";
  member.bundle.spec_sha256 = "abc";
  member.bundle.emitted[kMjcf].sha256 = "def";
  member.bundle.resolved_json = R"({"name": "every_kind"})";
  member.settings = {{"simulation.step", "0.02"}, {"simulation.duration", "10 s"}};
  Member& result = member.result;
  result.engines = {engine_run("bsm", model), engine_run("mujoco", model)};
  result.engines[1].trajectory.samples[1].omega_BN_B.x() = 2.5e-13;
  result.comparison = compare(model, result.engines[0].trajectory, result.engines[1].trajectory);
  result.conservation = {{"energy_relative", 1.0e-13, "bsm"},
                         {"momentum_relative", 2.0e-14, "bsm", 1.0e-12},
                         {"angular_momentum_relative", 3.0e-15, "bsm"}};
  result.references = {{"kepler", "bsm", {{"position_m", 0.5, 1.0}}}};
  result.timing = Timing{3, {{"bsm", {1.0, 2.0, 3.0}, 1000}, {"mujoco", {8.0, 8.0, 8.0}, 1000}}};
  result.complete = true;
  Report report{provenance(), {}};
  report.members.push_back(std::move(member));
  return report;
}

json parsed(const Report& report) { return json::parse(report_json(report)); }

TEST(ReportJson, NamesItsFormatVerdictAndSpec) {
  const json report = parsed(sound_report());
  EXPECT_EQ(report["format"], "twincraft-report/1");
  EXPECT_EQ(report["complete"], true);
  EXPECT_EQ(report["verdict"], "agree");
  EXPECT_EQ(report["spec"], (json{{"name", "every_kind"},
                                  {"file", "spec.yaml"},
                                  {"sha256", "abc"},
                                  {"degrees_of_freedom", 15}}));
  EXPECT_TRUE(report["studies"].is_object());
}

TEST(ReportJson, SaysWhichProgramAndMachineMadeIt) {
  const json provenance = parsed(sound_report())["provenance"];
  EXPECT_EQ(provenance["program"], "scsim " TWINCRAFT_VERSION);
  EXPECT_THAT(provenance["instructions"], AnyOf("x86-64", "AVX2", "AVX-512"));
  EXPECT_THAT(provenance["instructions_available"], testing::Contains(provenance["instructions"]));
  EXPECT_FALSE(provenance["instructions_reason"].get<std::string>().empty());
  for (const char* key : {"compiler", "flags", "mujoco", "eigen"})
    EXPECT_FALSE(provenance[key].get<std::string>().empty()) << key;
  for (const char* key : {"git", "cpu"}) EXPECT_TRUE(provenance[key].is_string()) << key;
  EXPECT_GE(provenance["cores"], 1);
  EXPECT_TRUE(provenance["load_average"].is_number());
}

TEST(ReportJson, KeepsSettingsAsNumbersWhereTheyAre) {
  const json member = parsed(sound_report())["members"][0];
  EXPECT_EQ(member["settings"]["simulation.step"], 0.02);
  EXPECT_EQ(member["settings"]["simulation.duration"], "10 s");
  EXPECT_EQ(member["resolved"]["name"], "every_kind");
  EXPECT_EQ(member["emitted_sha256"], (json{{"mjcf", "def"}}));
}

TEST(ReportJson, GivesEveryMetricMaximumTimeToleranceAndPass) {
  const json agreement = parsed(sound_report())["members"][0]["agreement"];
  EXPECT_EQ(agreement["rate_rad_s"],
            (json{{"max", 2.5e-13}, {"at_s", 0.5}, {"tolerance", 1.0e-12}, {"pass", true}}));
  EXPECT_EQ(agreement["attitude_deg"]["tolerance"], nullptr);
  EXPECT_EQ(agreement["attitude_deg"]["pass"], nullptr);
}

TEST(ReportJson, GivesEachEngineItsFinalStateByName) {
  Report report = sound_report();
  Observation& last = report.members[0].result.engines[0].trajectory.samples.back();
  last.q_BN = Quaterniond(0.5, -0.5, 0.5, -0.5);
  last.joint_position[1] = 0.125;
  last.joint_rate[6] = 0.25;
  last.wheel_rate[1] = 7.0;
  const json bsm = parsed(report)["members"][0]["engines"]["bsm"];
  EXPECT_EQ(bsm["status"], "ok");
  EXPECT_EQ(bsm["steps"], 2);
  EXPECT_EQ(bsm["evaluations"], 8);
  EXPECT_EQ(bsm["final"]["q_BN"], (json{0.5, -0.5, 0.5, -0.5}));
  const json& coordinates = bsm["final"]["coordinates"];
  EXPECT_EQ(coordinates.size(), 9u);
  EXPECT_EQ(coordinates["wing.2"], (json{{"position", 0.125}, {"rate", 0.0}}));
  EXPECT_EQ(coordinates["bob.theta"]["rate"], 0.25);
  EXPECT_EQ(coordinates["rw_y"], (json{{"rate", 7.0}}));
  EXPECT_EQ(bsm["conservation"]["momentum_relative"], 2.0e-14);
}

TEST(ReportJson, GivesReferencesByNameAndEngine) {
  const json references = parsed(sound_report())["members"][0]["references"];
  EXPECT_EQ(references["kepler"]["bsm"]["position_m"],
            (json{{"max", 0.5}, {"at_s", 1.0}, {"tolerance", nullptr}, {"pass", nullptr}}));
  Report judged = sound_report();
  judged.members[0].result.references[0].deviations[0].tolerance = 0.25;
  EXPECT_EQ(parsed(judged)["members"][0]["references"]["kepler"]["bsm"]["position_m"],
            (json{{"max", 0.5}, {"at_s", 1.0}, {"tolerance", 0.25}, {"pass", false}}));
  EXPECT_EQ(parsed(judged)["verdict"], "disagree");
}

TEST(ReportJson, GivesEveryBalanceItsWorstEngineToleranceAndPass) {
  Report report = sound_report();
  report.members[0].result.conservation[2] = {"angular_momentum_relative", 5.0e-12, "mujoco",
                                              1.0e-12};
  const json conservation = parsed(report)["members"][0]["conservation"];
  EXPECT_EQ(conservation["energy_relative"],
            (json{{"max", 1.0e-13}, {"engine", "bsm"}, {"tolerance", nullptr}, {"pass", nullptr}}));
  EXPECT_EQ(conservation["momentum_relative"],
            (json{{"max", 2.0e-14}, {"engine", "bsm"}, {"tolerance", 1.0e-12}, {"pass", true}}));
  EXPECT_EQ(
      conservation["angular_momentum_relative"],
      (json{{"max", 5.0e-12}, {"engine", "mujoco"}, {"tolerance", 1.0e-12}, {"pass", false}}));
  EXPECT_EQ(parsed(report)["verdict"], "disagree");
}

TEST(ReportJson, GivesTrialsMedianAndRatio) {
  const json timing = parsed(sound_report())["members"][0]["timing"];
  EXPECT_EQ(timing["protocol"], "warmup=1 trials=3 interleaved reversed");
  EXPECT_EQ(timing["bsm"]["trials_s"], (json{1.0, 2.0, 3.0}));
  EXPECT_EQ(timing["bsm"]["median_s"], 2.0);
  EXPECT_EQ(timing["bsm"]["us_per_step"], 2000.0);
  EXPECT_EQ(timing["ratio_bsm_over_mujoco"], 0.25);
}

TEST(ReportJson, SaysWhyAnEngineWasSkippedAndNothingElseOfIt) {
  Report report = sound_report();
  Member& result = report.members[0].result;
  result.engines[1] = {"mujoco", EngineRun::Status::kSkipped, "a chain too deep", {}, {}, {}};
  result.comparison.reset();
  result.conservation.clear();
  result.timing.reset();
  const json member = parsed(report)["members"][0];
  EXPECT_EQ(member["engines"]["mujoco"],
            (json{{"status", "skipped"}, {"reason", "a chain too deep"}}));
  EXPECT_EQ(member["agreement"], json::object());
  EXPECT_FALSE(member.contains("timing"));
  EXPECT_EQ(parsed(report)["verdict"], "not_judged");
}

TEST(ReportJson, WritesWhatIsNoNumberAsNullAndAsAFailure) {
  Report report = sound_report();
  Member& result = report.members[0].result;
  result.engines[0].trajectory.samples[1].omega_BN_B.x() = std::nan("");
  result.comparison = compare(report.members[0].bundle.model, result.engines[0].trajectory,
                              result.engines[1].trajectory);
  const json rate = parsed(report)["members"][0]["agreement"]["rate_rad_s"];
  EXPECT_EQ(rate["max"], nullptr);
  EXPECT_EQ(rate["pass"], false);
}

TEST(ReportVerdict, NeedsEveryMemberToAgree) {
  Report report = sound_report();
  report.members.push_back(report.members[0]);
  EXPECT_EQ(report.verdict(), Verdict::kAgree);
  report.members[1].result.comparison.reset();
  report.members[1].result.conservation.clear();
  EXPECT_EQ(report.verdict(), Verdict::kNotJudged);
  report.members[0].result.comparison->metrics[0].tolerance = -1.0;
  EXPECT_EQ(report.verdict(), Verdict::kDisagree);
}

TEST(Csv, HasTheColumnsOfTheInterfaceInTheirOrder) {
  const Model model = test::model_of_every_kind();
  const std::string header = split(trajectory_csv(model, test::standstill(model)), '\n').front();
  EXPECT_THAT(
      split(header, ','),
      ElementsAre("t [s]", "r_BN_N.x [m]", "r_BN_N.y [m]", "r_BN_N.z [m]", "v_BN_N.x [m/s]",
                  "v_BN_N.y [m/s]", "v_BN_N.z [m/s]", "q_BN.w [1]", "q_BN.x [1]", "q_BN.y [1]",
                  "q_BN.z [1]", "omega_BN_B.x [rad/s]", "omega_BN_B.y [rad/s]",
                  "omega_BN_B.z [rad/s]", "r_CN_N.x [m]", "r_CN_N.y [m]", "r_CN_N.z [m]",
                  "v_CN_N.x [m/s]", "v_CN_N.y [m/s]", "v_CN_N.z [m/s]", "rw_x.rate [rad/s]",
                  "rw_y.rate [rad/s]", "wing.1.position [rad]", "wing.1.rate [rad/s]",
                  "wing.2.position [rad]", "wing.2.rate [rad/s]", "arm.position [rad]",
                  "arm.rate [rad/s]", "rail.position [m]", "rail.rate [m/s]", "slosh.position [m]",
                  "slosh.rate [m/s]", "bob.phi.position [rad]", "bob.phi.rate [rad/s]",
                  "bob.theta.position [rad]", "bob.theta.rate [rad/s]", "mass [kg]"));
}

TEST(Csv, ReadsBackAsTheSameDoubles) {
  const Model model = test::model_of_every_kind();
  Trajectory trajectory = test::standstill(model);
  const std::vector<double> awkward{
      0.1, -7000123.456789012, 5e-324, 1.7976931348623157e308, 1.0 / 3.0, 1e-6};
  Observation& sample = trajectory.samples[1];
  sample.r_BN_N = {awkward[0], awkward[1], awkward[2]};
  sample.v_BN_N = {awkward[3], awkward[4], awkward[5]};
  const std::string line = split(trajectory_csv(model, trajectory), '\n').at(2);
  const std::vector<std::string> cells = split(line, ',');
  for (std::size_t i = 0; i < awkward.size(); ++i) {
    const std::string& cell = cells.at(i + 1);
    double value = 0.0;
    std::from_chars(cell.data(), cell.data() + cell.size(), value);
    EXPECT_EQ(value, awkward[i]) << cell;
  }
  EXPECT_EQ(cells[1], "0.1");
}

TEST(Csv, HasOneLinePerSampleAndAsManyCellsAsHeaders) {
  const Model model = test::model_of_every_kind();
  const std::vector<std::string> lines =
      split(trajectory_csv(model, test::standstill(model)), '\n');
  ASSERT_EQ(lines.size(), 4u);
  for (const std::string& line : lines) EXPECT_EQ(split(line, ',').size(), 37u);
}

TEST(Csv, PutsEachCoordinateUnderItsOwnName) {
  const Model model = test::model_of_every_kind();
  Trajectory trajectory = test::standstill(model);
  Observation& sample = trajectory.samples[0];
  sample.wheel_rate = {1.0, 2.0};
  for (std::size_t i = 0; i < 7; ++i) {
    sample.joint_position[i] = 10.0 + static_cast<double>(i);
    sample.joint_rate[i] = 20.0 + static_cast<double>(i);
  }
  EXPECT_THAT(split(trajectory_csv(model, trajectory), '\n').at(1),
              testing::EndsWith(",1,2,10,20,11,21,12,22,13,23,14,24,15,25,16,26,100"));
}

TEST(Table, ShowsVehiclePlanAndVerdict) {
  const std::string table = report_table(sound_report().members[0], false);
  EXPECT_THAT(table, HasSubstr("every_kind   15 DOF: hub, 2 wheels, 1 panel, 2 jointed bodies, 1 "
                               "slosh particle, 1 slosh pendulum   1 s, rk4 at 0.5 s, no gravity"));
  EXPECT_THAT(table, HasSubstr("\nthe engines agree\n"));
  EXPECT_THAT(table, Not(HasSubstr("\x1b")));
}

TEST(Table, ShowsMaximumTimeToleranceAndJudgement) {
  const std::string table = report_table(sound_report().members[0], false);
  EXPECT_THAT(table, HasSubstr("  body rate          2.5e-13 rad/s  0.50 s      1e-12 rad/s      "
                               "ok\n"));
  EXPECT_THAT(table, HasSubstr("  system CoM         0 m            0.00 s      -\n"));
}

TEST(Table, GivesReferencesALinePerEngine) {
  const std::string table = report_table(sound_report().members[0], false);
  EXPECT_THAT(table, HasSubstr("  kepler position    5.0e-01 m      1.00 s      BSM\n"));
}

TEST(Table, GivesBalancesTheirToleranceAndJudgement) {
  const std::string table = report_table(sound_report().members[0], false);
  EXPECT_THAT(table, HasSubstr("conservation         BSM            MuJoCo      tolerance\n"));
  EXPECT_THAT(table, HasSubstr("  energy balance     1.0e-13        1.0e-13     relative\n"));
  EXPECT_THAT(table, HasSubstr("  momentum           2.0e-14        2.0e-14     1e-12 relative   "
                               "ok\n"));
}

TEST(Table, NamesEveryKindOfToleranceThatWasBroken) {
  Report report = sound_report();
  Member& result = report.members[0].result;
  result.references[0].deviations[0].tolerance = 0.25;
  EXPECT_THAT(report_table(report.members[0], false),
              HasSubstr("5.0e-01 m      1.00 s      BSM              0.25 m         EXCEEDED\n"));
  EXPECT_THAT(report_table(report.members[0], false),
              HasSubstr("\nan engine is further from `kepler` than allowed\n"));
  result.conservation[0] = {"energy_relative", 1.0, "mujoco", 1.0e-9};
  result.comparison->metrics[0].tolerance = -1.0;
  EXPECT_THAT(report_table(report.members[0], false),
              HasSubstr("\nthe engines disagree; the energy balance of MuJoCo exceeds its "
                        "tolerance; an engine is further from `kepler` than allowed\n"));
}

TEST(Table, SaysThatTheEnginesAgreeOnlyWhereAgreementWasJudged) {
  Report report = sound_report();
  report.members[0].result.comparison->metrics[1].tolerance.reset();
  EXPECT_THAT(report_table(report.members[0], false), HasSubstr("\nevery tolerance held\n"));
}

TEST(Table, ComparesCosts) {
  const std::string table = report_table(sound_report().members[0], false);
  EXPECT_THAT(table, HasSubstr("  BSM                2 ms           2 s         8\n"));
  EXPECT_THAT(table, HasSubstr("  MuJoCo             8 ms           8 s         8                "
                               "4x\n"));
}

TEST(Table, PaintsAFailureOnATerminal) {
  Report report = sound_report();
  report.members[0].bundle.model.agreement.rate = 1.0e-14;
  Member& result = report.members[0].result;
  result.comparison = compare(report.members[0].bundle.model, result.engines[0].trajectory,
                              result.engines[1].trajectory);
  EXPECT_THAT(report_table(report.members[0], false), HasSubstr("EXCEEDED\n"));
  EXPECT_THAT(report_table(report.members[0], true), HasSubstr("\x1b["));
}

TEST(Table, SaysWhyNothingWasJudged) {
  Report report = sound_report();
  Member& result = report.members[0].result;
  result.engines[1] = {"mujoco", EngineRun::Status::kSkipped, "a chain too deep", {}, {}, {}};
  result.comparison.reset();
  result.conservation.clear();
  EXPECT_THAT(report_table(report.members[0], false),
              HasSubstr("not judged; MuJoCo: a chain too deep\n"));
}

TEST(Words, TellALongRunInDaysOrYears) {
  EXPECT_EQ(span_words(0.02), "0.02 s");
  EXPECT_EQ(span_words(5400.0), "5400 s");
  EXPECT_EQ(span_words(2592000.0), "30 days");
  EXPECT_EQ(span_words(315569259.75), "10 years");
}

TEST(Words, SayWhatPropellantTakesAlong) {
  Model model;
  model.simulation.duration = 10.0;
  const auto tank = [](const std::string& name, double flow, LeavingMomentum momentum) {
    return Tank{name, 100.0, Schedule::constant(flow), momentum};
  };
  EXPECT_EQ(depletion_words(model), "");
  model.tanks = {tank("shut", 0.0, LeavingMomentum::kJet)};
  EXPECT_EQ(depletion_words(model), "");
  model.tanks.push_back(tank("plain", 1.0, LeavingMomentum::kNone));
  EXPECT_EQ(depletion_words(model), "propellant leaves without angular momentum: no jet damping");
  model.tanks.push_back(tank("jet", 1.0, LeavingMomentum::kJet));
  EXPECT_EQ(depletion_words(model), "jet damping from 1 of 2 draining tanks");
  model.tanks.erase(model.tanks.begin() + 1);
  EXPECT_EQ(depletion_words(model), "propellant leaves with the nozzle's velocity: jet damping");
}

TEST(Words, AreUnderTheHeadingAndInReportJsonWhereATankDrains) {
  Report report = sound_report();
  Model& model = report.members[0].bundle.model;
  EXPECT_FALSE(json::parse(report_json(report))["members"][0].contains("depletion"));
  EXPECT_THAT(heading(model), testing::EndsWith("no gravity\n\n"));
  model.tanks = {{"main", 100.0, Schedule::constant(1.0)}};
  const std::string words = "propellant leaves without angular momentum: no jet damping";
  EXPECT_EQ(json::parse(report_json(report))["members"][0]["depletion"], words);
  EXPECT_THAT(heading(model), testing::EndsWith("no gravity\n" + words + "\n\n"));
}

TEST(Words, GiveDurationsAUnitThatFits) {
  EXPECT_EQ(duration(6.2e-7), "620 ns");
  EXPECT_EQ(duration(3.6e-3), "3.6 ms");
  EXPECT_EQ(duration(0.9996), "1 s");
  EXPECT_EQ(duration(12.345), "12.3 s");
  EXPECT_EQ(duration(4321.0), "4321 s");
}

TEST(Words, CallPanelAnglesWhatTheyAre) {
  Model model;
  model.coordinates = {{"wing.1", Coordinate::Kind::kPanel, 1}};
  EXPECT_EQ(words_of("joint_deg", model).label, "panel angle");
  EXPECT_EQ(words_of("joint_deg", test::model_of_every_kind()).label, "joint angles");
}

TEST(Progress, EstimatesWhatIsLeft) {
  EXPECT_EQ(progress_line("bsm", 0.25, 3.0), "bsm     [#####...............]  25 %  9 s left");
  EXPECT_EQ(progress_line("bsm", 0.25, 3.0, 120.0),
            "bsm     [#####...............]  25 %  t = 30 s of 120 s  9 s left");
  EXPECT_EQ(progress_line("timing", 1.0, 3.0), "timing  [####################] 100 %");
}

}  // namespace
}  // namespace twincraft
