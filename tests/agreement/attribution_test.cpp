// Claims about `scsim attribute` as its user meets it: Sections 6.2 to 6.5 of the paper are four
// runs of it. The runs are the paper's own length where that takes seconds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"

namespace twincraft {
namespace {

using nlohmann::json;
using test::ProgramResult;
using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kModels = TWINCRAFT_ROOT "/models/paper/";

/// In uniform motion, and nothing else happens to it.
const std::string kDrifter = R"(format: spacecraft/1
name: drifter
hub: {mass: 750, inertia: [900, 800, 600]}
initial: {velocity: [2142.8571428571427, -3214.285714285714, 6428.571428571428]}
engines: {mujoco: {frame: inertial}}
simulation: {integrator: rk4, step: 0.1, duration: 60, record: 1}
)";

class Attribute : public testing::Test {
 protected:
  ProgramResult run(std::vector<std::string> arguments, test::ProgramInput input = {}) {
    arguments.insert(arguments.begin(), "attribute");
    arguments.insert(arguments.end(), {"-o", folder.path() + "/out"});
    return test::run_program(TWINCRAFT_SCSIM, arguments, input);
  }
  json report() const { return json::parse(folder.read("out/report.json")); }
  json explanation() const { return report()["explanation"]; }
  json cause(const std::string& key) const {
    const json causes = report()["attribution"];
    for (const json& each : causes)
      if (each["cause"] == key) return each;
    ADD_FAILURE() << "no cause " << key;
    return {};
  }

  TemporaryFolder folder;
};

TEST_F(Attribute, FindsTheTokenWheelMass) {  // Section 6.3
  const ProgramResult result =
      run({kModels + "rw_panels.yaml", "--set", "engines.mujoco.compensate=false"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const json mass = cause("wheel_mass");
  EXPECT_EQ(report()["attribution"][0], mass);
  EXPECT_EQ(mass["metric"], "attitude_deg");
  // The paper: 6.3e-10 deg, some rounding of its own in it.
  EXPECT_NEAR(mass["maximum"].get<double>(), 6.4e-10, 0.1e-10);
  EXPECT_GE(mass["share"], 0.95);
  EXPECT_EQ(mass["law"]["variable"], "wheel mass");
  EXPECT_NEAR(mass["law"]["exponent"].get<double>(), 1.0, 0.05);
  EXPECT_EQ(explanation()["remainder_is"], "rounding");
  EXPECT_LT(explanation()["remainder"], 5.0e-12);  // the spec's own tolerance
  EXPECT_EQ(report()["verdict"], "disagree");      // which is explained, not excused
  EXPECT_EQ(report()["complete"], true);
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("what carries the difference in attitude"),
                    HasSubstr("linear in wheel mass, slope 1.0"), HasSubstr("is rounding\n")));
}

TEST_F(Attribute, FindsTheApplicationOfGravity) {  // Section 6.4; seconds long: one orbit
  const ProgramResult result =
      run({kModels + "orbit_extended.yaml", "--set", "engines.bsm.gravity=system_com"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const json gravity = cause("gravity_application");
  EXPECT_EQ(report()["attribution"][0], gravity);
  EXPECT_NEAR(gravity["maximum"].get<double>(), 45.5, 0.2);
  EXPECT_GE(gravity["share"], 0.999);
  EXPECT_LT(gravity["maximum_without"], 1.0e-6);  // the spec's tolerance
  EXPECT_TRUE(gravity["law"].is_null());
  EXPECT_EQ(gravity["removed_by"], json{"engines.bsm.gravity=body_com"});
  // What is left without it is the other cause, and small as it is its law can be measured.
  EXPECT_NEAR(cause("attitude_chart")["law"]["exponent"].get<double>(), 4.0, 0.2);
  EXPECT_EQ(explanation()["remainder_is"], "rounding");
}

TEST_F(Attribute, FindsTheBobInertia) {  // Section 6.5; a tenth of the burn
  const ProgramResult result =
      run({kModels + "variable_mass.yaml", "--set", "engines.mujoco.bob_inertia=1.0e-4",  //
           "--set", "engines.mujoco.particle_inertia=1.0e-6", "--duration", "90 s"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const json bob = cause("bob_inertia");
  EXPECT_EQ(report()["attribution"][0], bob);
  EXPECT_GE(bob["share"], 0.95);
  EXPECT_NEAR(bob["law"]["exponent"].get<double>(), 1.0, 0.05);
  EXPECT_EQ(bob["law"]["factors"], (json{10.0, 1.0, 0.1}));
  const json particle = cause("particle_inertia");
  EXPECT_LT(std::abs(particle["share"].get<double>()), 0.01);
  EXPECT_NEAR(particle["law"]["exponent"].get<double>(), 1.0, 0.05);
  EXPECT_EQ(explanation()["remainder_is"], "rounding");
  // Taken away one after another, the differences end at the remainder.
  EXPECT_EQ(report()["attribution"].back()["maximum_left"], explanation()["remainder"]);
}

TEST_F(Attribute, FindsTheVelocityArtefact) {  // Section 6.2
  const ProgramResult result =
      run({kModels + "torque.yaml", "--set", "engines.mujoco.frame=inertial"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const json artefact = cause("velocity_artefact");
  EXPECT_EQ(report()["attribution"][0], artefact);
  EXPECT_GE(artefact["share"], 0.8);  // its size is that of a build of MuJoCo
  EXPECT_TRUE(artefact["law"].is_null());
  EXPECT_THAT(artefact["no_law"].get<std::string>(), HasSubstr("not scaled"));
  EXPECT_EQ(explanation()["remainder_is"], "rounding");
  EXPECT_THAT(result.out, HasSubstr("the velocity artefact ("));
}

TEST_F(Attribute, FindsTheAttitudeChartAndItsOrder) {
  const ProgramResult result = run({kModels + "torque.yaml"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  ASSERT_EQ(report()["attribution"].size(), 1u);
  const json chart = cause("attitude_chart");
  EXPECT_NEAR(chart["share"].get<double>(), 1.0, 1e-3);
  EXPECT_EQ(chart["law"]["variable"], "step");
  EXPECT_NEAR(chart["law"]["exponent"].get<double>(), 4.0, 0.1);
  EXPECT_EQ(explanation()["remainder_is"], "rounding");
  EXPECT_THAT(result.out, HasSubstr("fourth order in the step, "));
}

TEST_F(Attribute, ScalesTheSpeedWhereThereIsOne) {
  const ProgramResult result = run({"-"}, {kDrifter, {}});  // a spec that can be read only once
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const json artefact = cause("velocity_artefact");
  EXPECT_NEAR(artefact["law"]["exponent"].get<double>(), 2.0, 0.05);
  EXPECT_EQ(artefact["law"]["factors"], (json{1.0, 0.5, 0.25}));
  EXPECT_EQ(artefact["maximum_without"], 0.0);
  EXPECT_THAT(result.out, HasSubstr("quadratic in speed, 2.0"));
}

TEST_F(Attribute, HasNothingToExplainWhereTheEnginesAgreeToRounding) {
  const ProgramResult result = run({kModels + "rw_panels.yaml"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("nothing to explain: attitude differs by "),
                                HasSubstr("5e-12 deg        ok"), Not(HasSubstr("carries"))));
  EXPECT_THAT(report()["attribution"], IsEmpty());
  EXPECT_EQ(explanation()["nothing_to_explain"], true);
}

TEST_F(Attribute, LooksAtTheCentreOfMassOfAPointMass) {
  const ProgramResult result = run({kModels + "orbit.yaml", "--duration", "600 s"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(explanation()["metric"], "com_position_m");
}

TEST_F(Attribute, TakesTheSpecItselfOfAStudy) {
  const ProgramResult result =
      run({kModels + "studies/rw_wheel_mass.yaml", "--duration", "20 s", "--jobs", "1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("its study was left out"));
  EXPECT_EQ(report()["attribution"][0]["cause"], "wheel_mass");
  EXPECT_EQ(report()["members"].size(), 1u);
}

TEST_F(Attribute, IsTheSameForAnyNumberOfJobs) {
  ASSERT_EQ(run({kModels + "torque.yaml", "--duration", "20 s", "--jobs", "1"}).exit_code, 0);
  const json one = report()["attribution"];
  ASSERT_EQ(run({kModels + "torque.yaml", "--duration", "20 s", "--jobs", "4"}).exit_code, 0);
  EXPECT_EQ(one.dump(), report()["attribution"].dump());
}

TEST_F(Attribute, ExitsAsTheOtherCommandsDo) {
  const std::string faulty = folder.write("faulty.yaml", kDrifter + "wheel: []\n");
  EXPECT_EQ(run({faulty}).exit_code, 1);
  EXPECT_EQ(run({folder.path() + "/none.yaml"}).exit_code, 3);
  const ProgramResult slip = run({kModels + "torque.yaml", "--quite"});
  EXPECT_EQ(slip.exit_code, 2);
  EXPECT_THAT(slip.err, HasSubstr("did you mean `--quiet`?"));
  const ProgramResult quiet = run({kModels + "torque.yaml", "--duration", "1 s", "--quiet"});
  EXPECT_EQ(quiet.exit_code, 0);
  EXPECT_THAT(quiet.out + quiet.err, IsEmpty());
}

TEST_F(Attribute, SaysWhatCouldNotBeFlown) {
  const std::string spec = folder.write("drifter.yaml", kDrifter);
  const ProgramResult result = run({spec, "--set", "initial.rate=[1e20, 0, 1e20]"});
  EXPECT_EQ(result.exit_code, 4) << result.out;
  EXPECT_THAT(result.err, HasSubstr("nothing to attribute: "));
}

TEST_F(Attribute, HelpSaysHowSharesAreMeasured) {
  const ProgramResult result = run({"--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("share: the part of the difference"),
                                HasSubstr("Example: scsim attribute")));
  EXPECT_LE(std::count(result.out.begin(), result.out.end(), '\n'), 40);
}

TEST_F(Attribute, CanBeInterrupted) {
  const std::string spec = folder.write("drifter.yaml", kDrifter);
  const ProgramResult result = run({spec, "--duration", "1.0e9 s", "--set",  //
                                    "simulation.record=10000 s", "--progress", "always"},
                                   test::signalled_after(R"(both    \[)", SIGINT));
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_EQ(report()["complete"], false);
}

}  // namespace
}  // namespace twincraft
