// A model as a script for Basilisk: which half can express it, and what is written. The scripts are
// flown by tests/basilisk.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "compiler/diag/diagnostics.h"
#include "compiler/emit/python_text.h"
#include "compiler/pipeline.h"

namespace twincraft {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Json = nlohmann::ordered_json;

const std::string kHub =
    "format: spacecraft/1\n"
    "name: v\n"
    "hub: {mass: 100, inertia: [10, 11, 12]}\n";
const std::string kRun = "simulation: {step: 0.5, duration: 1}\n";

std::string written_at(const Span& span, const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  for (int i = 0; i < span.line; ++i) std::getline(lines, line);
  return line.substr(static_cast<std::size_t>(span.column) - 1,
                     static_cast<std::size_t>(span.length));
}

/// A spec with these sections, as a script.
struct Emitted {
  std::string text;
  std::vector<std::string> refusals, notes;  // in the order of the report
  std::vector<std::string> refused;          // as the spec names those of `refusals`

  explicit Emitted(const std::string& sections, const std::string& run = kRun) {
    const CompileRequest request{"v.yaml", {}, kHub + sections + run};
    Diagnostics diagnostics;
    const LoadResult loaded = load_spec(request, diagnostics);
    std::optional<Bundle> bundle;
    if (loaded.spec) bundle = loaded.spec->compile({kBasilisk}, diagnostics);
    for (const Diagnostic& each : diagnostics.all()) {
      if (each.code == Code::kHalfRefused) refusals.push_back(each.message);
      if (each.code == Code::kHalfRefused) refused.push_back(written_at(each.span, *request.text));
      if (each.code == Code::kHalfRewritten) notes.push_back(each.message);
      if (each.severity == Severity::kError) ADD_FAILURE() << each.message;
    }
    if (bundle) text = bundle->text(kBasilisk);
  }
};

const std::string kArm =
    "  - {name: arm, joint: {type: revolute, axis: [0, 0, 1]}, mass: 5, inertia: [1, 1, 1]}\n";
std::string body(const std::string& name, const std::string& parent, const std::string& type) {
  return "  - {name: " + name + ", parent: " + parent + ", joint: {type: " + type +
         ", axis: [0, 1, 0]}, mass: 1, inertia: [1, 1, 1]}\n";
}
const std::string kTank =
    "tanks:\n  - {name: fuel, shape: {sphere: {radius: 0.5}}, propellant: 20}\n";

TEST(Basilisk, HasBothHalvesOfAChainWithWheels) {
  const Emitted script("bodies:\n" + kArm + body("hand", "arm", "revolute") +
                       "wheels:\n  - {name: rw, axis: [1, 0, 0], spin_inertia: 0.02, "
                       "transverse_inertia: 0.0125, torque: [[0, 0.1], [0.5, 0]]}\n");
  EXPECT_THAT(script.refusals, IsEmpty());
  EXPECT_THAT(script.notes, IsEmpty());
  EXPECT_THAT(script.text,
              AllOf(HasSubstr("REFUSED = {} if "), HasSubstr("\"rw\": [[1, 0, 0], 0.02]"),
                    HasSubstr("HINGES = {"), HasSubstr("<body name=\"hand\"")));
  EXPECT_THAT(script.text,
              HasSubstr("INPUTS = [[0, {\"rw.torque\": 0.1}], [0.5, {\"rw.torque\": 0}]]"));
}

TEST(Basilisk, RefusesInItsBsmSloshThatMovesWithABody) {
  EXPECT_THAT(Emitted("bodies:\n" + kArm +
                      "slosh:\n  - {name: p, type: particle, mount: arm, position: [0, 0, 0], "
                      "mass: 1, axis: [1, 0, 0], stiffness: 1}\n")
                  .refusals,
              ElementsAre(HasSubstr("it moves on `arm`, and Basilisk's slosh is on the hub")));
}

/// Sections with one thing that a half cannot have, where that is said and why.
struct Unfit {
  const char* name;
  std::string sections;
  const char* component;  // as the spec names it
  const char* said;
};

class BasiliskRefuses : public testing::TestWithParam<Unfit> {};

TEST_P(BasiliskRefuses, AtTheComponent) {
  const Emitted script(GetParam().sections);
  ASSERT_THAT(script.refusals, ElementsAre(HasSubstr(GetParam().said)));
  EXPECT_THAT(script.refused, ElementsAre(GetParam().component));
  EXPECT_NE(script.text, "");
}

std::string bodies(const std::string& more = "") { return "bodies:\n" + kArm + more; }
std::string wheel(const std::string& name, const std::string& mount) {
  return "  - {name: " + name + ", mount: " + mount +
         ", axis: [1, 0, 0], spin_inertia: 0.02, transverse_inertia: 0.0125}\n";
}
std::string bob(const std::string& more) {
  return "slosh:\n  - {name: bob, type: pendulum, mass: 5, length: 0.25, rest: [0, 0, -1], "
         "reference: [1, 0, 0], position: [0, 0, 0]" +
         more + "}\n";
}
std::string many_wheels() {
  std::string all = "wheels:\n";
  for (int i = 0; i < 37; ++i) all += wheel("w" + std::to_string(i), "hub");
  return all;
}
const std::string kPlanet =
    "initial: {position: [7000 km, 0, 0]}\nenvironment: {gravity: {mu: 3.986e14, ";

INSTANTIATE_TEST_SUITE_P(
    Half, BasiliskRefuses,
    testing::Values(
        Unfit{"branches", bodies(body("l", "arm", "revolute") + body("r", "arm", "revolute")),
              "arm", "BSM: `l` and `r` branch off it"},
        Unfit{"slide_on_a_hinge", bodies(body("slide", "arm", "prismatic")), "slide",
              "BSM: it slides on `arm`, which turns"},
        Unfit{"hinge_on_a_slide",
              "bodies:\n" + body("slide", "hub", "prismatic") + body("hand", "slide", "revolute"),
              "hand", "BSM: it turns on `slide`, which slides"},
        Unfit{"wheel_not_on_the_tip",
              bodies(body("hand", "arm", "revolute")) + "wheels:\n" + wheel("rw", "arm"), "rw",
              "BSM: its mount `arm` carries more than the wheel"},
        Unfit{"two_wheels_on_a_tip", bodies() + "wheels:\n" + wheel("a", "arm") + wheel("b", "arm"),
              "b", "BSM: `arm` carries another wheel"},
        Unfit{"wheel_on_a_slide",
              "bodies:\n" + body("slide", "hub", "prismatic") + "wheels:\n" + wheel("rw", "slide"),
              "rw", "BSM: its mount `slide` slides"},
        Unfit{"many_wheels", many_wheels(), "v", "BSM: 37 wheels are on the hub"},
        Unfit{"tank_on_a_body",
              bodies() + "tanks:\n  - {name: fuel, mount: arm, shape: {sphere: {radius: 0.5}}, "
                         "propellant: 20}\n",
              "fuel", "BSM: it moves with `arm`"},
        Unfit{"bob_with_inertia", bob(", inertia: 0.5"), "bob", "BSM: its bob has an inertia"},
        Unfit{"bob_beyond_45_deg", bob(", angles: [0, 50 deg]"), "bob",
              "BSM: its second angle is beyond 45 deg"},
        Unfit{"load_at_a_moving_centre",
              bodies() + "loads:\n  - {name: kick, force: [1, 0, 0], position: com}\n", "kick",
              "BSM: it acts at the centre of mass"},
        Unfit{"gradient_of_many_parts", bodies() + kPlanet + "application: body_gradient}}\n", "v",
              "BSM: its parts feel the gradient of gravity"},
        Unfit{"chain_too_deep_for_mujoco",
              "panels:\n  - {name: wing, hinge: {position: [1, 0, 0], axis: [0, 1, 0], outboard: "
              "[1, 0, 0]}, segments: 96, mass: 50, length: 9.6, stiffness: 10, inertia: {shape: "
              "bar, axial_ratio: 0.05, axial_minimum: 1.0e-4}}\n",
              "v", "MJScene: a chain of 96 bodies"}),
    [](const auto& instance) { return instance.param.name; });

TEST(Basilisk, RefusesInItsBsmABobWithInertiaAndAJet) {
  EXPECT_THAT(Emitted("slosh:\n  - {name: bob, type: pendulum, mass: 5, length: 0.25, rest: [0, 0, "
                      "-1], reference: [1, 0, 0], position: [0, 0, 0], inertia: 0.5}\n")
                  .refusals,
              ElementsAre(HasSubstr("its bob has an inertia, and Basilisk's is a point")));
  EXPECT_THAT(
      Emitted("tanks:\n  - {name: fuel, shape: {sphere: {radius: 0.5}}, propellant: 20, depletion: "
              "{momentum: jet}}\nthrusters:\n  - {name: main, direction: [0, 0, 1], thrust: 1 N, "
              "isp: 200 s, tank: fuel}\n")
          .refusals,
      ElementsAre(HasSubstr("its jet takes momentum along by another law")));
}

TEST(Basilisk, RefusesInItsBsmALoadAtACentreOfMassThatMoves) {
  const std::string kick = "loads:\n  - {name: kick, force: [1, 0, 0], position: com}\n";
  EXPECT_THAT(Emitted(kick).refusals, IsEmpty());
  EXPECT_THAT(Emitted("bodies:\n" + kArm + kick).refusals,
              ElementsAre(HasSubstr("it acts at the centre of mass, which moves")));
}

TEST(Basilisk, RefusesMoreMotorsThanAMessageHolds) {
  const auto panels = [](int segments, const std::string& more) {
    return "panels:\n  - {name: w, hinge: {position: [0, 0, 0], axis: [0, 1, 0], outboard: [1, 0, "
           "0]}, segments: " +
           std::to_string(segments) + ", mass: 40, length: 4, inertia: [1, 2, 3]}\n" + more;
  };
  EXPECT_THAT(Emitted(panels(37, "")).refusals, IsEmpty());
  std::string chain = kArm;
  std::string last = "arm";
  for (int i = 0; i < 36; ++i) {
    const std::string name = "b" + std::to_string(i);
    chain += body(name, last, "revolute");
    last = name;
  }
  EXPECT_THAT(Emitted("bodies:\n" + chain +
                      "wheels:\n  - {name: rw, mount: b35, axis: [1, 0, 0], spin_inertia: 0.02, "
                      "transverse_inertia: 0.0125, torque: 0.1}\n")
                  .refusals,
              ElementsAre(HasSubstr("38 joints, and Basilisk's message for motors holds 36")));
}

TEST(Basilisk, MakesAWheelOnATipTheLastBodyOfItsChain) {
  const Emitted script("bodies:\n" + kArm +
                       "wheels:\n  - {name: rw, mount: arm, axis: [1, 0, 0], spin_inertia: 0.02, "
                       "transverse_inertia: 0.0125}\n");
  EXPECT_THAT(script.refusals, IsEmpty());
  EXPECT_THAT(script.notes, ElementsAre(HasSubstr("it is the last body of the chain `arm`")));
  // What is left of the arm: 1 kg m2 and the wheel's tensor, less one that is round about x.
  EXPECT_THAT(script.text, HasSubstr("[[1, 0, 0], [0, 1.0025, 0], [0, 0, 1.0025]]"));
  EXPECT_THAT(script.text, HasSubstr("\"rw\": {\n        \"Mass\": 1e-06"));
}

TEST(Basilisk, SaysWhichLawOfGravityItHas) {
  const std::string planet =
      "environment: {gravity: {mu: 3.986e14, application: body_com}}\n"
      "initial: {position: [7000 km, 0, 0]}\n";
  EXPECT_THAT(Emitted("bodies:\n" + kArm + planet).notes,
              ElementsAre(HasSubstr("gravity pulls at the centre of mass (`system_com`)"),
                          HasSubstr("MJScene counts from the planet's centre")));
  EXPECT_THAT(Emitted(planet).notes, ElementsAre(HasSubstr("MJScene counts from")));
}

TEST(Basilisk, HasATankWithoutABulk) {
  const Emitted script(kTank +
                       "slosh:\n  - {name: p, type: particle, tank: fuel, mass: 20, axis: [1, 0, "
                       "0], stiffness: 1}\n");
  EXPECT_THAT(script.text, HasSubstr("\"fuel\": {\"mass\": 0, "));
  EXPECT_THAT(script.text, HasSubstr("TANK_OF = {\"p\": \"fuel\"}"));
}

TEST(Basilisk, RoundsTimesToNanosecondsAndSaysSo) {
  EXPECT_THAT(Emitted("", "simulation: {step: 0.5 s, duration: 1 s}\n").notes, IsEmpty());
  EXPECT_THAT(Emitted("", "simulation: {step: 1.5 ns, duration: 1 us}\n").notes,
              ElementsAre(HasSubstr("whole nanoseconds")));
}

TEST(Basilisk, IsNotWrittenWhereNoHalfExpressesTheVehicle) {
  const Emitted script("", "simulation: {step: 0.1 ns, duration: 1 us}\n");
  EXPECT_EQ(script.text, "");
  EXPECT_THAT(script.refusals, ElementsAre(HasSubstr("BSM: Basilisk counts whole nanoseconds"),
                                           HasSubstr("MJScene: Basilisk counts whole nano")));
}

TEST(Basilisk, KeepsAStrangersTextInItsDocstring) {
  const Emitted script("description: 'end \"\"\" and \\u00 \"'\n");
  EXPECT_THAT(script.text, HasSubstr("\"\"\"v: end \\\"\\\"\\\" and \\\\u00 \\\""));
  EXPECT_THAT(script.text, Not(HasSubstr("end \"\"\"")));
}

TEST(PythonText, BreaksLongLiteralsBetweenTheirParts) {
  const Json numbers = std::vector<double>(40, 0.125);
  const std::string text = assignment("A", {{"x", numbers}, {"y", 1}});
  EXPECT_EQ(text.find("A = {\n    \"x\": [\n        0.125, 0.125,"), 0u);
  EXPECT_THAT(text, HasSubstr("0.125], \"y\": 1}\n"));
}

TEST(PythonText, WritesWhatPythonReads) {
  EXPECT_EQ(assignment("A", {nullptr, true, 2, 0.5, "\u00e9\"\\"}),
            "A = [None, True, 2, 0.5, \"\\u00e9\\\"\\\\\"]\n");
  EXPECT_EQ(assignment("A", Json::array(), "none"), "A = []  # none\n");
}

}  // namespace
}  // namespace twincraft
