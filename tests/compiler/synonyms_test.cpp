// What other tools call things leads to our words, and only there.
#include "compiler/schema/synonyms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compiler/schema/table_info.h"

namespace twincraft {
namespace {

using testing::HasSubstr;

const std::vector<std::string> kMethods{"euler", "rk2", "rk4", "rkf45", "rkf78"};
const std::vector<std::string> kJoints{"revolute", "prismatic", "fixed"};
const std::vector<std::string> kDirections{"velocity", "orbit_normal", "radial"};

TableInfo table(std::string name, const std::vector<std::string>& keys) {
  TableInfo info{.name = std::move(name), .doc = {}, .fields = {}, .groups = {}};
  for (const std::string& key : keys) info.fields.push_back(required_field(key, {}, {}, {}, {}));
  return info;
}

TEST(Synonyms, OfKeysBelongToTheirSection) {
  const TableInfo orbit = table("orbit", {"semi_major_axis", "raan", "argument_of_periapsis"});
  EXPECT_EQ(hint_for_key(orbit, "sma"), "did you mean `semi_major_axis`?");
  EXPECT_EQ(hint_for_key(orbit, "SMA"), "did you mean `semi_major_axis`?");
  EXPECT_EQ(hint_for_key(orbit, "Omega"), "did you mean `raan`?");
  EXPECT_EQ(hint_for_key(orbit, "omega"), "did you mean `argument_of_periapsis`?");
  EXPECT_THAT(hint_for_key(orbit, "altitude"), HasSubstr("plus the altitude"));
  EXPECT_EQ(hint_for_key(orbit, "dt"), "");
  const TableInfo simulation = table("simulation", {"step", "duration"});
  EXPECT_EQ(hint_for_key(simulation, "dt"), "did you mean `step`?");
  EXPECT_EQ(hint_for_key(simulation, "Time-Step"), "did you mean `step`?");
  EXPECT_EQ(hint_for_key(simulation, "sma"), "");
}

TEST(Synonyms, TakeAUnitOffAKey) {
  const TableInfo hub = table("hub", {"mass", "inertia"});
  EXPECT_THAT(hint_for_key(hub, "mass_kg"), HasSubstr("did you mean `mass`? a unit stands with"));
  EXPECT_THAT(hint_for_key(hub, "inertia_kg_m2"), HasSubstr("did you mean `inertia`?"));
  EXPECT_EQ(hint_for_key(hub, "mass_of_hub"), "");
}

TEST(Synonyms, OfIntegratorsNeverLeadFromAdaptiveToFixedSteps) {
  for (const char* word : {"rk45", "RK45", "rkf4", "rkf5", "ode45", "dopri5", "rkf54", "rk4(5)",
                           "rk46", "rkf-45", "RK-45", "rkf455", "adaptive", "rk54"})
    EXPECT_EQ(hint_for_word(word, kMethods), "did you mean `rkf45`?") << word;
  for (const char* word : {"rk78", "rkf7", "rkf8", "dop853", "rk8(7)", "rkf787"})
    EXPECT_EQ(hint_for_word(word, kMethods), "did you mean `rkf78`?") << word;
  for (const char* word : {"rk-4", "RK4", "ode4", "runge_kutta"})
    EXPECT_EQ(hint_for_word(word, kMethods), "did you mean `rk4`?") << word;
  EXPECT_EQ(hint_for_word("forward_euler", kMethods), "did you mean `euler`?");
  EXPECT_EQ(hint_for_word("quux", kMethods), "");
}

TEST(Synonyms, OfWordsBelongToTheirChoice) {
  EXPECT_EQ(hint_for_word("hinge", kJoints), "did you mean `revolute`?");
  EXPECT_EQ(hint_for_word("slider", kJoints), "did you mean `prismatic`?");
  EXPECT_EQ(hint_for_word("weld", kJoints), "did you mean `fixed`?");
  EXPECT_THAT(hint_for_word("ball", kJoints), HasSubstr("several revolute joints in a row"));
  EXPECT_EQ(hint_for_word("hinge", kMethods), "");
  EXPECT_EQ(hint_for_word("321", {"xyz", "zyx"}), "did you mean `zyx`?");
  EXPECT_EQ(hint_for_word("ZYX", {"xyz", "zyx"}), "did you mean `zyx`?");
}

TEST(Synonyms, OfDirectionsDoNotFlipTheVehicle) {
  for (const char* word : {"-orbit_normal", "-velocity", "-radial"})
    EXPECT_THAT(hint_for_word(word, kDirections), HasSubstr("put the minus on `axis`")) << word;
  for (const char* word : {"nadir", "retrograde", "anti_normal"})
    EXPECT_THAT(hint_for_word(word, kDirections), HasSubstr("put a minus on `axis`")) << word;
  EXPECT_EQ(hint_for_word("zenith", kDirections), "did you mean `radial`?");
  EXPECT_EQ(hint_for_word("normal", kDirections), "did you mean `orbit_normal`?");
}

}  // namespace
}  // namespace twincraft
