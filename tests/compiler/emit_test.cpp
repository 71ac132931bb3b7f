// The printers: same model, same bytes; nothing lost; no component known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compiler/emit/assembly_json.h"
#include "compiler/emit/dot.h"
#include "compiler/emit/json.h"
#include "compiler/emit/resolved.h"
#include "tests/compiler/vehicles.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;

Model vehicle() {
  Model model = test::boom_and_wheels().build();
  model.name = "boom";
  model.assembly.rotors[0].torque = Schedule::constant(0.1);
  model.assembly.rotors[1].torque.entries = {{0.0, 0.02}, {40.0, -0.02}};
  model.initial.omega_BN_B = {1.0 / 3.0, -2e-300, 0.1};
  model.initial.q_BN = Quaterniond(0.5, -0.5, 0.5, 0.5);
  return model;
}

TEST(JsonText, PutsPlainListsOnOneLineAndMapsOnSeveral) {
  const Json json = {{"a", {1.0, 0.1, 1e-6}}, {"b", {{{"c", "x\"y"}}}}, {"d", Json::array()}};
  EXPECT_EQ(json_text(json),
            "{\n  \"a\": [1, 0.1, 1e-06],\n  \"b\": [\n    {\n      \"c\": \"x\\\"y\"\n    }\n"
            "  ],\n  \"d\": []\n}\n");
}

TEST(EmitBsm, GivesTheSameBytesForTheSameModel) {
  EXPECT_EQ(emit_bsm(vehicle()), emit_bsm(vehicle()));
}

TEST(EmitBsm, LosesNoBitOfANumber) {
  const Model model = vehicle();
  const Json json = Json::parse(emit_bsm(model));
  for (std::size_t l = 0; l < model.assembly.links.size(); ++l) {
    const Link& link = model.assembly.links[l];
    const Json& written = json["links"][l];
    ASSERT_EQ(written["elements"].size(), link.elements.size());
    for (std::size_t e = 0; e < link.elements.size(); ++e) {
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          const double value = written["elements"][e]["I_PntE_L_kg_m2"][i][j].get<double>();
          EXPECT_EQ(value, link.elements[e].I_PntE_L(static_cast<int>(i), static_cast<int>(j)));
        }
      }
    }
    if (l == 0) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(written["joint"]["dcm_PL0"][i][0].get<double>(),
                link.joint.dcm_PL0(static_cast<int>(i), 0));
      EXPECT_EQ(written["joint"]["axis_L"][i].get<double>(),
                link.joint.axis_L[static_cast<int>(i)]);
    }
  }
  EXPECT_EQ(json["initial"]["omega_BN_B_rad_s"][0].get<double>(), 1.0 / 3.0);
  EXPECT_EQ(json["initial"]["omega_BN_B_rad_s"][1].get<double>(), -2e-300);
}

TEST(EmitBsm, WritesWhatAlwaysHeldWithoutATime) {
  const Json json = Json::parse(emit_bsm(vehicle()));
  EXPECT_EQ(json["rotors"][0]["torque_N_m"].dump(), "[[null,0.1]]");
  EXPECT_EQ(json["rotors"][1]["torque_N_m"][1][1].get<double>(), -0.02);
}

TEST(EmitBsm, NamesUnitsByTheKindOfJoint) {
  const Json json = Json::parse(emit_bsm(vehicle()));
  EXPECT_TRUE(json["links"][1]["joint"].contains("stiffness_N_m_rad"));
  EXPECT_TRUE(json["links"][2]["joint"].contains("rest_m"));
  EXPECT_FALSE(json["links"][0].contains("joint"));
  EXPECT_EQ(json["coordinates"][2]["rotor"], 0);
}

TEST(EmitDot, DrawsBothHalvesAndWhatStandsForWhat) {
  const std::string dot = emit_dot(vehicle());
  EXPECT_THAT(dot, HasSubstr("digraph \"boom\""));
  EXPECT_THAT(dot, HasSubstr("link0 -> link1 [label=\"hinge\"]"));
  EXPECT_THAT(dot, HasSubstr("link1 -> link2 [label=\"slide\"]"));
  EXPECT_THAT(dot, HasSubstr("link1 -> rotor1 [label=\"rotor\"]"));
  EXPECT_THAT(dot, HasSubstr("link2 -> body2 [style=dotted"));
}

TEST(EmitResolved, WritesBlockYaml) {
  const Json spec = {{"name", "brick"},
                     {"description", "on: off"},
                     {"flag", true},
                     {"hub", {{"mass", 600.0}, {"inertia", {{1.0, 0.0}, {0.0, 1e-6}}}}},
                     {"wheels", {{{"name", "rw_x"}, {"at", {{"x", 1.5}}}}, {{"name", "no"}}}},
                     {"panels", Json::array()}};
  EXPECT_EQ(emit_resolved(spec),
            "name: brick\n"
            "description: \"on: off\"\n"
            "flag: true\n"
            "hub:\n"
            "  mass: 600\n"
            "  inertia: [[1, 0], [0, 1e-06]]\n"
            "wheels:\n"
            "  - name: rw_x\n"
            "    at:\n"
            "      x: 1.5\n"
            "  - name: \"no\"\n"
            "panels: []\n");
}

}  // namespace
}  // namespace twincraft
