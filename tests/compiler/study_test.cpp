// Claims about studies as the compiler sees them: which members there are, in which order, and what
// is said of their faults.
#include "compiler/spec/study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <thread>

#include "compiler/diag/print.h"
#include "compiler/pipeline.h"
#include "compiler/syntax/load.h"
#include "tests/compiler/compile_text.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kBrick =
    "format: spacecraft/1\nname: brick\nhub: {mass: 600 kg, inertia: [400, 380, 360]}\n"
    "simulation: {step: 0.1 s, duration: 1 s, record: 0.5 s}\nagreement: {attitude: 1 deg}\n";

constexpr const char* kPanel =
    "panels:\n"
    "  - {name: wing, hinge: {position: [1, 0, 0], axis: [0, 1, 0], outboard: [1, 0, 0]},\n"
    "     mass: 60, length: 3, inertia: {shape: bar}, stiffness: 600}\n";

class StudyOfAFile : public CompilesText {
 protected:
  Bundle member(const std::optional<Compiled>& result, std::size_t index) {
    Diagnostics diagnostics;
    std::optional<Bundle> bundle =
        result->spec.member(index, {kAssemblyJson, kResolved}, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors());
    return std::move(bundle.value());
  }

  /// With a text of its own.
  Bundle variant(const std::optional<Compiled>& result, std::size_t index) {
    constexpr std::array kUnits{"kg", "t", "lb", "slug", "dag", "pound"};
    const std::string change =
        "hub.mass=" + std::to_string(1000 + index) + " " + kUnits.at(index % kUnits.size());
    Diagnostics diagnostics;
    std::optional<Bundle> bundle = result->spec.variant({change}, {kAssemblyJson}, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors()) << to_text(diagnostics, {});
    return std::move(bundle.value());
  }

  /// `a,x` for every member: the texts of what it sets.
  std::vector<std::string> members(const std::optional<Compiled>& result) {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < result->spec.study()->members; ++i) {
      all.emplace_back();
      for (const Setting& setting : member(result, i).settings)
        all.back() += (all.back().empty() ? "" : ",") + setting.text;
    }
    return all;
  }
};

TEST_F(StudyOfAFile, LetsTheLastPathOfAGridVaryFastest) {
  const std::optional<Compiled> result =
      compile_text(std::string(kBrick) +
                   "study:\n  sweep:\n    - {set: simulation.step, values: [0.1, 0.05]}\n"
                   "    - {set: simulation.integrator, values: [euler, rk2, rk4]}\n");
  ASSERT_TRUE(result);
  EXPECT_THAT(result->spec.study()->paths, ElementsAre("simulation.step", "simulation.integrator"));
  EXPECT_THAT(members(result),
              ElementsAre("0.1,euler", "0.1,rk2", "0.1,rk4", "0.05,euler", "0.05,rk2", "0.05,rk4"));
}

TEST_F(StudyOfAFile, HoldsMembersAgainstTheFirstValueOfOnePath) {
  const std::string sweep =
      "    - {set: simulation.step, values: [0.1, 0.05]}\n"
      "    - {set: hub.mass, values: [1, 2, 3]}\n"
      "    - {set: simulation.integrator, values: [rk2, rk4]}\n";
  const std::optional<Compiled> result =
      compile_text(std::string(kBrick) + "study:\n  compare: hub.mass\n  sweep:\n" + sweep);
  ASSERT_TRUE(result);
  const StudyPlan& plan = *result->spec.study();
  ASSERT_EQ(plan.compare, 1u);
  std::vector<std::size_t> baselines;
  for (std::size_t i = 0; i < plan.members; ++i) baselines.push_back(plan.baseline_of(i));
  EXPECT_THAT(baselines, ElementsAre(0, 1, 0, 1, 0, 1, 6, 7, 6, 7, 6, 7));
  EXPECT_EQ(plan.last_held_against(1), 5u);
  EXPECT_EQ(plan.last_held_against(6), 10u);
}

TEST_F(StudyOfAFile, HoldsAZipAgainstItsFirstMember) {
  const std::optional<Compiled> result = compile_text(
      std::string(kBrick) +
      "study:\n  combine: zip\n  compare: hub.mass\n  sweep:\n"
      "    - {set: hub.mass, values: [1, 2]}\n    - {set: simulation.step, values: [0.1, 0.05]}\n");
  ASSERT_TRUE(result);
  EXPECT_EQ(result->spec.study()->baseline_of(1), 0u);
  EXPECT_EQ(result->spec.study()->last_held_against(0), 1u);
}

TEST_F(StudyOfAFile, PairsTheValuesOfAZip) {
  const std::optional<Compiled> result = compile_text(
      std::string(kBrick) +
      "study:\n  combine: zip\n  sweep:\n    - {set: simulation.step, values: [0.1, 50 ms]}\n"
      "    - {set: simulation.record, values: [1, 0.5]}\n");
  ASSERT_TRUE(result);
  EXPECT_THAT(members(result), ElementsAre("0.1,1", "50 ms,0.5"));
  EXPECT_EQ(member(result, 1).model.simulation.step, 0.05);
}

TEST_F(StudyOfAFile, KnowsSweptNumbersInSi) {
  const std::optional<Compiled> result =
      compile_text(std::string(kBrick) + "study: {sweep: [{set: hub.mass, values: [1 t, 2 t]}]}\n",
                   {"initial.velocity=[3, 4, 0]", "simulation.integrator=rk2"});
  ASSERT_TRUE(result);
  const std::vector<Setting> settings = member(result, 1).settings;
  ASSERT_THAT(settings, SizeIs(3));  // the command line's first
  EXPECT_EQ(settings[0].value, 5.0);
  EXPECT_EQ(settings[1].value, std::nullopt);
  EXPECT_EQ(settings[2].value, 2000.0);
}

TEST_F(StudyOfAFile, MakesMembersFromTheSpecWithoutItsStudy) {
  const std::optional<Compiled> result =
      compile_text(std::string(kBrick) + "study: {sweep: [{set: hub.mass, values: [1 t]}]}\n");
  ASSERT_TRUE(result);
  EXPECT_THAT(result->bundle.resolved_json, HasSubstr("\"study\""));
  EXPECT_THAT(member(result, 0).resolved_json, Not(HasSubstr("\"study\"")));
  EXPECT_EQ(result->bundle.model.assembly.links[0].elements[0].mass, 600.0);
}

TEST_F(StudyOfAFile, EvaluatesAStepRuleForEveryMember) {
  const std::optional<Compiled> result =
      compile_text(std::string(kBrick) + kPanel +
                       "study: {sweep: [{set: panels.*.segments, values: [1, 2, 4]}]}\n",
                   {"simulation.step={per_period: 200, of: wing, maximum: 0.01}"});
  ASSERT_TRUE(result);
  const double first = member(result, 0).model.simulation.step;
  const double third = member(result, 2).model.simulation.step;
  EXPECT_EQ(first, 0.01);
  EXPECT_NEAR(third, 0.0021509014535795535, 1.0e-16);
  EXPECT_EQ(member(result, 2).model.assembly.links.size(), 5u);
}

TEST_F(StudyOfAFile, EndsWorkPrecisionWithReferenceAndCheckAndJudgesNothing) {
  const std::optional<Compiled> result = compile_text(
      std::string(kBrick) +
      "study:\n  work_precision:\n    configurations:\n"
      "      - {integrator: rk4, set: simulation.step, values: [0.2, 0.1]}\n"
      "      - {integrator: rkf45, step: 0.5, set: simulation.tolerance, values: [1.0e-6]}\n"
      "    reference: {step: 0.25}\n");
  ASSERT_TRUE(result);
  EXPECT_THAT(members(result), ElementsAre("rk4,0.2", "rk4,0.1", "rkf45,0.5,1.0e-6",
                                           "rkf78,0.25,1e-13", "rkf78,0.25,1e-12"));
  EXPECT_TRUE(result->bundle.model.agreement.attitude);
  EXPECT_FALSE(member(result, 0).model.agreement.attitude);
}

TEST_F(StudyOfAFile, PointsAtTheValueThatIsWrong) {
  const std::optional<Compiled> result =
      compile_text(std::string(kBrick) + "study: {sweep: [{set: hub.mass, values: [1 t, -2]}]}\n");
  EXPECT_FALSE(result);
  ASSERT_THAT(diagnostics_.all(), SizeIs(1));
  const Diagnostic& fault = diagnostics_.all()[0];
  EXPECT_EQ(fault.span.line, 6);
  EXPECT_EQ(fault.span.column, 47);
  EXPECT_THAT(fault.notes, IsEmpty());
}

TEST_F(StudyOfAFile, NotesTheValueThatMakesAnotherOneWrong) {
  const std::optional<Compiled> result = compile_text(
      std::string(kBrick) + "study: {sweep: [{set: simulation.duration, values: [1, 50 ms]}]}\n");
  EXPECT_FALSE(result);
  ASSERT_THAT(diagnostics_.all(), SizeIs(1));
  const Diagnostic& fault = diagnostics_.all()[0];
  EXPECT_EQ(fault.code, Code::kStepTooLong);
  EXPECT_EQ(fault.span.line, 4);
  ASSERT_FALSE(fault.notes.empty());
  EXPECT_EQ(fault.notes.back().span.line, 6);
  EXPECT_THAT(fault.notes.back().message, HasSubstr("member 2"));
}

TEST_F(StudyOfAFile, GivesTheSameMembersOnAnyNumberOfThreads) {
  const std::optional<Compiled> result =
      compile_text(std::string(kBrick) + kPanel +
                   "study:\n  sweep:\n    - {set: panels.*.segments, values: [1, 2, 3, 4]}\n"
                   "    - {set: panels.*.length, values: [3 m, 9.9 ft, 300 cm, 118 in]}\n"
                   "    - {set: hub.mass, values: [1 t, 2204.7 lb, 900 kg]}\n");
  ASSERT_TRUE(result);
  const std::size_t count = result->spec.study()->members;
  std::vector<std::string> texts(count);
  std::vector<std::thread> threads;
  for (std::size_t first = 0; first < 4; ++first)
    threads.emplace_back([&, first] {
      for (std::size_t i = first; i < count; i += 4)
        texts[i] = member(result, i).text(kAssemblyJson) + variant(result, i).text(kAssemblyJson);
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < count; ++i)
    EXPECT_EQ(texts[i],
              member(result, i).text(kAssemblyJson) + variant(result, i).text(kAssemblyJson))
        << i;
}

TEST_F(StudyOfAFile, ReportsAFaultThatManyMembersShareOnce) {
  compile_text(std::string(kBrick) +
               "study:\n  sweep:\n    - {set: hub.mass, values: [-1, 1]}\n"
               "    - {set: simulation.record, values: [1, 0.5, 0.2]}\n");
  EXPECT_THAT(diagnostics_.all(), SizeIs(1));
}

TEST(StudyMembers, AreAMillionWithoutBeingMade) {
  Sources sources;
  std::string list;
  for (int i = 0; i < 1000; ++i) list += (i == 0 ? "" : ", ") + std::to_string(i);
  const Source& source =
      sources.add("study", "sweep:\n  - {set: hub.mass, values: [" + list +
                               "]}\n  - {set: simulation.step, values: [" + list + "]}\n");
  Diagnostics diagnostics;
  const std::optional<Node> node = parse(source, diagnostics);
  const StudySpec spec = study_table().read(*node, diagnostics);
  const std::optional<StudyMembers> members = members_of(spec, diagnostics);
  ASSERT_TRUE(members);
  EXPECT_EQ(members->plan.members, 1'000'000u);
  const std::vector<Override> last = members->overrides(123'456);
  EXPECT_EQ(last[0].value.scalar, "123");
  EXPECT_EQ(last[1].value.scalar, "456");
}

}  // namespace
}  // namespace twincraft
