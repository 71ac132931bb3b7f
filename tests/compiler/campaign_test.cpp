// Claims about campaigns as the compiler sees them: what is drawn, that it is drawn again by its
// settings alone, and that nothing else moves it. Faults are in tests/malformed.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "compiler/components/physical.h"
#include "compiler/diag/print.h"
#include "compiler/pipeline.h"
#include "compiler/spec/campaign_members.h"
#include "tests/compiler/compile_text.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

constexpr const char* kCraft = R"(format: spacecraft/1
name: craft
hub: {mass: 600 kg, inertia: [400, 380, 360], center_of_mass: [0.1, 0, 0]}
wheels:
  - {name: rw_x, axis: [1, 0, 0], spin_inertia: 0.08, transverse_inertia: 0.05, speed: 100}
  - {name: rw_y, axis: [0, 1, 0], spin_inertia: 0.08, transverse_inertia: 0.05, torque: 0.01}
panels:
  - {name: wing_p, hinge: {position: [1, 0, 0], axis: [0, 1, 0], outboard: [1, 0, 0]},
     mass: 60, length: 3, inertia: {shape: bar}, stiffness: 600}
  - {name: wing_m, hinge: {position: [-1, 0, 0], axis: [0, 1, 0], outboard: [-1, 0, 0]},
     mass: 60, length: 3, inertia: {shape: bar}, stiffness: [500, 400], segments: 2}
bodies:
  - {name: arm, joint: {type: revolute, axis: [0, 0, 1], stiffness: 10}, mass: 5,
     inertia: [1, 1, 1], orientation: {euler: {sequence: zyx, angles: [0.1, 0.2, 0.3]}}}
  - {name: slide, joint: {type: prismatic, axis: [0, 0, 1], stiffness: 20}, mass: 5,
     inertia: [1, 1, 1]}
tanks:
  - {name: main, shape: {sphere: {radius: 1}}, propellant: 100}
initial: {rate: [0.01, 0, 0], attitude: {mrp: [0.1, 0.2, 0.3]}}
simulation: {step: 0.1 s, duration: 1 s, record: 0.5 s}
)";

class Campaign : public CompilesText {
 protected:
  /// A campaign whose further keys are `keys`, each dispersion a line of `dispersions`.
  std::optional<Compiled> campaign(const std::string& dispersions, const std::string& keys = "",
                                   std::vector<std::string> overrides = {}) {
    std::optional<Compiled> result =
        compile_text(std::string(kCraft) + "campaign:\n  members: 64\n  seed: 7\n" + keys +
                         "  dispersions:\n" + dispersions,
                     std::move(overrides));
    EXPECT_TRUE(result) << to_text(diagnostics_, {});
    return result;
  }

  static std::vector<std::string> names(const LoadedSpec& spec) {
    std::vector<std::string> all;
    for (const DrawnNumber& number : spec.campaign()->drawn) all.push_back(number.name);
    return all;
  }

  /// The numbers of one column, member by member.
  static std::vector<double> column(const LoadedSpec& spec, const std::string& name) {
    const std::vector<std::string> all = names(spec);
    const auto place = std::ranges::find(all, name) - all.begin();
    std::vector<double> numbers;
    for (std::size_t i = 0; i < spec.campaign()->members; ++i)
      numbers.push_back(spec.drawn(i).at(static_cast<std::size_t>(place)));
    return numbers;
  }

  static Bundle member(const LoadedSpec& spec, std::size_t index) {
    Diagnostics diagnostics;
    std::optional<Bundle> bundle =
        spec.campaign_member(index, {kMjcf, kAssemblyJson, kResolved}, diagnostics);
    EXPECT_TRUE(bundle) << to_text(diagnostics, {});
    return std::move(bundle.value());
  }
};

const char* const kAll =
    "    - {set: hub.mass, normal: {sigma: 2 %, truncate: 3}}\n"
    "    - {set: hub.inertia, inertia: {sigma: 5 %, tilt: 1 deg}}\n"
    "    - {set: hub.center_of_mass, uniform: {low: -1 mm, high: 1 mm}}\n"
    "    - {set: wheels.*.axis, cone: {sigma: 0.1 deg}}\n"
    "    - {set: wheels.rw_x.speed, triangular: {low: 90 %, high: 130 %}}\n"
    "    - {set: wheels.rw_y.torque, lognormal: {sigma: 10 %}}\n"
    "    - {set: panels.*.stiffness, uniform: {low: 80 %, high: 120 %}}\n"
    "    - {set: bodies.arm.orientation, rotation: {sigma: 1 deg}}\n"
    "    - {set: bodies.*.joint.stiffness, normal: {sigma: 1 %}}\n"
    "    - {set: initial.attitude, rotation: {sigma: 2 deg}}\n"
    "    - {set: initial.rate, normal: {sigma: 0.1 deg/s}}\n"
    "    - {set: tanks.main.propellant, choice: {values: [100 kg, 150 kg, 40 %]}}\n";

TEST_F(Campaign, NamesEveryNumberThatItDraws) {
  const std::optional<Compiled> result = campaign(kAll);
  ASSERT_TRUE(result);
  EXPECT_THAT(
      names(result->spec),
      ElementsAre(
          "hub.mass", "hub.inertia.xx", "hub.inertia.yy", "hub.inertia.zz", "hub.inertia.xy",
          "hub.inertia.xz", "hub.inertia.yz", "hub.center_of_mass.x", "hub.center_of_mass.y",
          "hub.center_of_mass.z", "wheels.rw_x.axis.x", "wheels.rw_x.axis.y", "wheels.rw_x.axis.z",
          "wheels.rw_y.axis.x", "wheels.rw_y.axis.y", "wheels.rw_y.axis.z", "wheels.rw_x.speed",
          "wheels.rw_y.torque", "panels.wing_p.stiffness", "panels.wing_m.stiffness.1",
          "panels.wing_m.stiffness.2", "bodies.arm.orientation.x", "bodies.arm.orientation.y",
          "bodies.arm.orientation.z", "bodies.arm.joint.stiffness", "bodies.slide.joint.stiffness",
          "initial.attitude.x", "initial.attitude.y", "initial.attitude.z", "initial.rate.x",
          "initial.rate.y", "initial.rate.z", "tanks.main.propellant"));
  const std::vector<DrawnNumber>& drawn = result->spec.campaign()->drawn;
  EXPECT_EQ(drawn[0].unit, "kg");
  EXPECT_EQ(drawn[0].nominal, 600.0);
  EXPECT_EQ(drawn[0].distribution, "normal, sigma 2 %, truncate 3");
  EXPECT_EQ(drawn[1].unit, "kg m2");
  EXPECT_EQ(drawn[10].unit, "1");
  EXPECT_EQ(drawn[20].nominal, 400.0);
  EXPECT_EQ(drawn[24].unit, "N m/rad");
  EXPECT_EQ(drawn[25].unit, "N/m");
  EXPECT_EQ(drawn[26].unit, "rad");
  EXPECT_EQ(drawn[32].distribution, "choice, values 100 kg or 150 kg or 40 %");
}

TEST_F(Campaign, GivesEveryMemberItsNumbers) {
  const std::optional<Compiled> result = campaign(kAll);
  ASSERT_TRUE(result);
  const std::vector<double> drawn = result->spec.drawn(5);
  const Model model = member(result->spec, 5).model;
  const MassElement& hub = model.assembly.links[0].elements[0];
  EXPECT_EQ(hub.mass, drawn[0]);
  const auto resolved = nlohmann::json::parse(member(result->spec, 5).resolved_json);
  EXPECT_EQ(resolved["hub"]["inertia"][0][0], drawn[1]);
  EXPECT_EQ(resolved["hub"]["inertia"][2][1], drawn[6]);
  EXPECT_EQ(hub.r_EL_L, Vector3d(drawn[7], drawn[8], drawn[9]));
  EXPECT_EQ(model.assembly.rotors[0].axis_L, Vector3d(drawn[10], drawn[11], drawn[12]));
  EXPECT_EQ(model.initial.omega_BN_B, Vector3d(drawn[29], drawn[30], drawn[31]));
  const Quaterniond turn = result->bundle.model.initial.q_BN.conjugate() * model.initial.q_BN;
  EXPECT_NEAR((2.0 * turn.vec() - Vector3d(drawn[26], drawn[27], drawn[28])).norm(), 0.0, 1.0e-4);
}

TEST_F(Campaign, IsReproducedMemberByMemberBySettings) {
  const std::optional<Compiled> result = campaign(kAll, "  sampling: sobol\n");
  ASSERT_TRUE(result);
  const std::string text = std::string(kCraft) + "campaign:\n  members: 64\n  seed: 7\n" +
                           "  sampling: sobol\n  dispersions:\n" + kAll;
  for (const std::size_t index : {0, 17, 63}) {
    const Bundle direct = member(result->spec, index);
    const std::vector<std::string> settings = result->spec.campaign_settings(index);
    EXPECT_EQ(settings.front(), "campaign=null");
    const std::optional<Compiled> alone = compile_text(text, settings);
    ASSERT_TRUE(alone) << to_text(diagnostics_, {});
    EXPECT_EQ(alone->spec.campaign(), nullptr);
    for (const char* target : {kMjcf, kAssemblyJson, kResolved})
      EXPECT_EQ(alone->bundle.text(target), direct.text(target)) << target;
    EXPECT_NE(alone->bundle.text(kAssemblyJson), result->bundle.text(kAssemblyJson));
  }
}

TEST_F(Campaign, LeavesTheNominalVehicleAsItIs) {
  const std::optional<Compiled> result = campaign(kAll);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->bundle.model.assembly.links[0].elements[0].mass, 600.0);
  EXPECT_THAT(result->bundle.resolved_json, HasSubstr("\"campaign\""));
  EXPECT_THAT(member(result->spec, 1).resolved_json, Not(HasSubstr("\"campaign\"")));
}

TEST_F(Campaign, MovesNoNumberWhenMembersOrDispersionsAreAdded) {
  const char* mass = "    - {set: hub.mass, normal: {sigma: 2 %}}\n";
  const std::optional<Compiled> one = campaign(mass);
  const std::optional<Compiled> all = campaign(kAll, "", {"campaign.members=100"});
  ASSERT_TRUE(one && all);
  const std::vector<double> before = column(one->spec, "hub.mass");
  std::vector<double> after =
      column(campaign(std::string(kAll).substr(std::string(kAll).find('\n') + 1) + mass, "",
                      {"campaign.members=100"})
                 ->spec,
             "hub.mass");
  ASSERT_THAT(after, SizeIs(100));
  after.resize(before.size());
  EXPECT_EQ(before, after);
  EXPECT_EQ(column(all->spec, "initial.rate.y").front(),
            column(campaign("    - {set: initial.rate, normal: {sigma: 0.1 deg/s}}\n")->spec,
                   "initial.rate.y")
                .front());
}

TEST_F(Campaign, DrawsTheSameFromManyThreads) {
  const std::optional<Compiled> result = campaign(kAll, "  sampling: latin_hypercube\n");
  ASSERT_TRUE(result);
  std::vector<std::vector<double>> drawn(8);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < drawn.size(); ++i)
    threads.emplace_back([&, i] { drawn[i] = result->spec.drawn(i); });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < drawn.size(); ++i) EXPECT_EQ(drawn[i], result->spec.drawn(i));
}

TEST_F(Campaign, DrawsMembersOfAListByThemselvesOrTogether) {
  const std::string stiffness = "    - {set: panels.*.mass, normal: {sigma: 10 %}";
  const std::optional<Compiled> alone = campaign(stiffness + "}\n");
  const std::optional<Compiled> together = campaign(stiffness + ", together: true}\n");
  ASSERT_TRUE(alone && together);
  EXPECT_NE(column(alone->spec, "panels.wing_p.mass"), column(alone->spec, "panels.wing_m.mass"));
  EXPECT_EQ(column(together->spec, "panels.wing_p.mass"),
            column(together->spec, "panels.wing_m.mass"));
}

TEST_F(Campaign, DrawsTogetherAboutEachNominalValue) {
  const std::optional<Compiled> result =
      campaign("    - {set: bodies.*.joint.stiffness, normal: {sigma: 10 %}, together: true}\n");
  ASSERT_TRUE(result);
  const std::vector<double> drawn = result->spec.drawn(3);
  EXPECT_DOUBLE_EQ(drawn[1], 2.0 * drawn[0]);
}

TEST_F(Campaign, CorrelatesWhatItDraws) {
  const std::optional<Compiled> result = campaign(
      "    - {set: hub.mass, normal: {sigma: 2 %}}\n"
      "    - {set: tanks.main.propellant, uniform: {low: 80 %, high: 120 %}}\n"
      "    - {set: initial.rate, normal: {sigma: 1 deg/s}}\n",
      "  correlate: [[hub.mass, tanks.main.propellant, 0.99], [hub.mass, initial.rate.z, -0.1]]\n");
  ASSERT_TRUE(result);
  const std::vector<double> mass = column(result->spec, "hub.mass");
  const std::vector<double> propellant = column(result->spec, "tanks.main.propellant");
  int same_side = 0;
  for (std::size_t i = 0; i < mass.size(); ++i)
    same_side += (mass[i] > 600.0) == (propellant[i] > 100.0) ? 1 : 0;
  EXPECT_GT(same_side, 56);  // of 64; 95 % are expected
}

TEST_F(Campaign, TellsOfAMemberThatIsNoVehicleWhenItIsCompiled) {
  const std::optional<Compiled> result =
      campaign("    - {set: hub.mass, uniform: {low: -1 kg, high: -0.5 kg}}\n");
  ASSERT_TRUE(result);
  Diagnostics diagnostics;
  EXPECT_FALSE(result->spec.campaign_member(3, {kAssemblyJson}, diagnostics));
  EXPECT_THAT(to_text(diagnostics, {}), HasSubstr("must be positive"));
  EXPECT_THAT(to_text(diagnostics, {}), HasSubstr("hub.mass"));
}

TEST_F(Campaign, PlansWhatIsAskedOfTheFlight) {
  const std::optional<Compiled> result = campaign(
      "    - {set: hub.mass, normal: {sigma: 2 %}}\n",
      "  outputs:\n"
      "    - {name: peak, of: wing_p.1.position, reduce: max_abs, require: {below: 5 deg}}\n"
      "    - {name: fast, of: omega_BN_B, reduce: max_norm}\n"
      "    - {name: still, of: wing_p.1.rate, reduce: settling_time, within: 1 deg/s,\n"
      "       require: {below: 1 min, above: 1 s}}\n"
      "    - {name: over, of: q_BN.w, reduce: first_crossing, level: 0.5}\n"
      "  stop: [{of: omega_BN_B.x, above: 10 deg/s}, {of: mass, below: 1 t}]\n"
      "  keep: {worst: 5, by: peak, members: [0, 17]}\n"
      "  twin: {every: 8}\n");
  ASSERT_TRUE(result);
  const CampaignPlan& plan = *result->spec.campaign();
  EXPECT_EQ(plan.members, 64u);
  EXPECT_EQ(plan.seed, 7u);
  ASSERT_THAT(plan.outputs, SizeIs(4));
  EXPECT_EQ(plan.outputs[0].signal, "wing_p.1.position");
  EXPECT_EQ(plan.outputs[0].unit, "rad");
  EXPECT_EQ(plan.outputs[0].below, 0.087266462599716474);
  EXPECT_EQ(plan.outputs[0].above, std::nullopt);
  EXPECT_EQ(plan.outputs[1].reduce, Reduce::kMaxNorm);
  EXPECT_EQ(plan.outputs[2].within, 0.017453292519943295);
  EXPECT_EQ(plan.outputs[2].unit, "s");
  EXPECT_EQ(plan.outputs[2].below, 60.0);
  EXPECT_EQ(plan.outputs[3].level, 0.5);
  ASSERT_THAT(plan.stops, SizeIs(2));
  EXPECT_EQ(plan.stops[0].above, 0.17453292519943295);
  EXPECT_EQ(plan.stops[1].below, 1000.0);
  EXPECT_EQ(plan.keep_worst, 5u);
  EXPECT_EQ(plan.keep_by, "peak");
  EXPECT_THAT(plan.keep_members, ElementsAre(0u, 17u));
  EXPECT_EQ(plan.twin_every, 8u);
}

TEST_F(Campaign, FillsInItsDefaults) {
  const std::optional<Compiled> result =
      compile_text(std::string(kCraft) +
                   "campaign: {members: 3, dispersions: [{set: hub.mass, normal: {sigma: 1}}]}\n");
  ASSERT_TRUE(result);
  const CampaignPlan& plan = *result->spec.campaign();
  EXPECT_EQ(plan.seed, 0u);
  EXPECT_EQ(plan.sampling, Sampling::kRandom);
  EXPECT_EQ(plan.twin_every, 100u);
  EXPECT_EQ(plan.keep_worst, 0u);
  EXPECT_THAT(plan.outputs, IsEmpty());
}

TEST_F(Campaign, ReadsBackItsResolvedText) {
  const std::optional<Compiled> first = campaign(
      kAll,
      "  sampling: sobol\n  correlate: [[hub.mass, wheels.rw_x.speed, 0.5]]\n"
      "  outputs: [{name: peak, of: wing_p.1.position, reduce: max, require: {below: 5 deg}}]\n");
  ASSERT_TRUE(first);
  const std::optional<Compiled> second = compile_text(first->bundle.resolved_json);
  ASSERT_TRUE(second) << to_text(diagnostics_, {});
  EXPECT_EQ(second->bundle.resolved_json, first->bundle.resolved_json);
  EXPECT_EQ(second->spec.drawn(9), first->spec.drawn(9));
  EXPECT_EQ(second->spec.campaign()->outputs[0].below, first->spec.campaign()->outputs[0].below);
}

TEST_F(Campaign, DrawsAboutAnAttitudeThatTheOrbitGives) {
  const std::optional<Compiled> result = compile_text(
      "format: spacecraft/1\nname: brick\nhub: {mass: 600 kg, inertia: [400, 380, 360]}\n"
      "simulation: {step: 0.1 s, duration: 1 s}\n"
      "environment: {gravity: {mu: 3.986e14}}\n"
      "initial: {position: [7000 km, 0, 0], velocity: [0, 0, 7500],\n"
      "  attitude: {align: [{axis: x, to: velocity}, {axis: z, to: radial}]}}\n"
      "campaign: {members: 3, dispersions: [{set: initial.attitude, rotation: {sigma: 0}},\n"
      "  {set: initial.position, normal: {sigma: 1 km}}]}\n");
  ASSERT_TRUE(result) << to_text(diagnostics_, {});
  const Quaterniond nominal = result->bundle.model.initial.q_BN;
  EXPECT_EQ(member(result->spec, 1).model.initial.q_BN.coeffs(), nominal.coeffs());
}

TEST_F(Campaign, DrawsInertiasThatSomeBodyHas) {
  const std::optional<Compiled> result =
      campaign("    - {set: hub.inertia, inertia: {sigma: 10 %, tilt: 5 deg}}\n", "",
               {"campaign.members=20000"});
  ASSERT_TRUE(result);
  for (std::size_t i = 0; i < 20'000; ++i) {
    const std::vector<double> d = result->spec.drawn(i);
    Matrix3d I;
    I << d[0], d[3], d[4], d[3], d[1], d[5], d[4], d[5], d[2];
    ASSERT_EQ(physicality(I), Physicality::kPhysical) << i;
  }
}

TEST_F(Campaign, SaysWhenSobolHasTooFewDimensions) {
  std::string loads = "loads:\n";
  for (int i = 0; i < 1223; ++i) loads += fmt::format("  - {{name: f{}, force: [1, 1, 1]}}\n", i);
  const std::string text = std::string(kCraft) + loads +
                           "campaign:\n  members: 4\n  sampling: sobol\n"
                           "  dispersions: [{set: loads.*.force, normal: {sigma: 1 %}}]\n";
  EXPECT_FALSE(compile_text(text));
  EXPECT_THAT(to_text(diagnostics_, {}), HasSubstr("error[SC3707]: the campaign draws 3669"));
}

TEST_F(Campaign, OutputsAreAlsoThoseOfASweep) {
  const std::optional<Compiled> result =
      compile_text(std::string(kCraft) +
                   "study:\n  sweep: [{set: hub.mass, values: [1 t, 2 t]}]\n"
                   "  outputs: [{name: peak, of: wing_p.1.position, reduce: max}]\n");
  ASSERT_TRUE(result) << to_text(diagnostics_, {});
  ASSERT_THAT(result->spec.study()->outputs, SizeIs(1));
  EXPECT_EQ(result->spec.study()->outputs[0].unit, "rad");
}

}  // namespace
}  // namespace twincraft
