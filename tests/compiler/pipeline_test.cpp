// From text to bundle: stages stop after errors, and what comes out depends on the text alone.
#include "compiler/pipeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "compiler/emit/target.h"
#include "compiler/ir/digest.h"
#include "tests/compiler/compile_text.h"

namespace twincraft {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Key;
using testing::Not;
using testing::Pair;
using testing::SizeIs;

class Pipeline : public CompilesText {
 protected:
  std::vector<Code> codes() const {
    std::vector<Code> found;
    for (const Diagnostic& diagnostic : diagnostics_.all()) found.push_back(diagnostic.code);
    return found;
  }
};

constexpr const char* kBrick =
    "format: spacecraft/1\nname: brick\nhub: {mass: 600 kg, inertia: [400, 380, 360]}\n"
    "simulation: {integrator: rk4, step: 0.1 s, duration: 1 s, record: 0.5 s}\n";

TEST_F(Pipeline, CompilesTheSmallestSpecWithoutAWord) {
  const std::optional<Compiled> result = compile_text(kBrick);
  ASSERT_TRUE(result);
  EXPECT_THAT(diagnostics_.all(), SizeIs(0));
  EXPECT_EQ(result->bundle.model.name, "brick");
  EXPECT_THAT(result->bundle.text(kMjcf), HasSubstr("brick"));
  EXPECT_EQ(result->bundle.spec_sha256, sha256(kBrick));
  EXPECT_EQ(nlohmann::json::parse(result->bundle.resolved_json)["hub"]["mass"], 600.0);
  for (const auto& [target, emitted] : result->bundle.emitted)
    EXPECT_EQ(emitted.sha256, sha256(emitted.text)) << target;
}

TEST_F(Pipeline, WritesTheTargetsThatAreWantedAndNoOthers) {
  const std::optional<Compiled> result = compile_text(kBrick);
  ASSERT_TRUE(result);
  for (const Target& target : targets()) {
    const std::optional<Bundle> bundle = result->spec.compile({target.name}, diagnostics_);
    ASSERT_TRUE(bundle);
    EXPECT_THAT(bundle->emitted, ElementsAre(Key(target.name)));
    EXPECT_FALSE(bundle->text(target.name).empty());
    EXPECT_EQ(bundle->resolved_json.empty(), target.name != kResolved);
  }
}

TEST_F(Pipeline, LeavesOutATargetThatTheModelRefuses) {
  const std::optional<Compiled> result =
      compile_text(std::string(kBrick) +
                   "panels:\n  - {name: wing, hinge: {position: [1, 0, 0], axis: [0, 1, 0], "
                   "outboard: [1, 0, 0]},\n     mass: 60, length: 300, inertia: {shape: bar}, "
                   "segments: 200, stiffness: 600}\n");
  ASSERT_TRUE(result);
  EXPECT_THAT(result->bundle.refused, ElementsAre(Pair(kMjcf, Not(IsEmpty()))));
  EXPECT_THAT(result->bundle.emitted, Not(Contains(Key(kMjcf))));
}

TEST_F(Pipeline, StopsAfterTheStageThatFoundFaults) {
  // The unknown key belongs to reading; the impossible inertia would be found by checking.
  const std::optional<Compiled> result =
      compile_text(std::string(kBrick) + "wheel: []\n", {"hub.inertia=[1, 1, 5]"});
  EXPECT_FALSE(result);
  EXPECT_EQ(codes(), (std::vector<Code>{Code::kUnknownKey}));
}

TEST_F(Pipeline, ReportsEveryFaultOfAStage) {
  compile_text("format: spacecraft/1\nname: brick\nhub: {mass: -1, inertia: 3, colour: red}\n");
  EXPECT_GE(diagnostics_.error_count(), 3u);
}

TEST_F(Pipeline, AppliesOverridesBeforeReading) {
  const std::optional<Compiled> result = compile_text(kBrick, {"hub.mass=1 t"});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->bundle.model.assembly.links[0].elements[0].mass, 1000.0);
  EXPECT_EQ(result->bundle.spec_sha256, sha256(kBrick));  // of the file as it is on disk
}

TEST_F(Pipeline, ReportsABadOverrideAsAFault) {
  EXPECT_FALSE(compile_text(kBrick, {"hub.mass"}));
  EXPECT_THAT(codes(), Contains(Code::kOverrideForm));
}

TEST_F(Pipeline, CompilesVariantsOnTopOfTheCommandLineAndWithoutTheStudy) {
  const std::optional<Compiled> result =
      compile_text(std::string(kBrick) + "study: {sweep: [{set: hub.mass, values: [1, 2]}]}\n",
                   {"hub.mass=700 kg"});
  ASSERT_TRUE(result);
  Diagnostics diagnostics;
  const auto resolved = [&](const std::vector<std::string>& overrides) {
    const std::optional<Bundle> variant = result->spec.variant(overrides, {kResolved}, diagnostics);
    return variant ? nlohmann::json::parse(variant->resolved_json) : nlohmann::json();
  };
  EXPECT_EQ(resolved({})["hub"]["mass"], 700.0);
  const nlohmann::json halved = resolved({"simulation.step=50 ms"});
  EXPECT_EQ(halved["hub"]["mass"], 700.0);
  EXPECT_EQ(halved["simulation"]["step"], 0.05);
  EXPECT_FALSE(halved.contains("study"));
  EXPECT_EQ(resolved({})["simulation"]["step"], 0.1);  // one variant leaves no trace in the next
  EXPECT_THAT(diagnostics.all(), SizeIs(0));
  EXPECT_TRUE(resolved({"hub.mass=-1"}).is_null());
  EXPECT_TRUE(diagnostics.has_errors());
}

TEST_F(Pipeline, CannotReadWhatIsNotThere) {
  const LoadResult loaded = load_spec({"/no/such/spec.yaml", {}}, diagnostics_);
  EXPECT_FALSE(loaded.spec);
  EXPECT_THAT(loaded.io_error, HasSubstr("no such file"));
}

TEST(Sha256, MatchesThePublishedExamples) {  // FIPS 180-2, appendix B
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(JsonSchema, SaysHowItIsMadeAgain) {
  const auto schema = nlohmann::json::parse(json_schema());
  EXPECT_THAT(schema["$comment"].get<std::string>(), HasSubstr("sccompile --schema"));
  EXPECT_EQ(schema["additionalProperties"], false);
}

// Found by tools/fuzz: the place of a file that is none was asked for, of a key that is not there.
TEST_F(Pipeline, RefusesADropWithoutExtendsInATextThatIsNoFile) {
  CompileRequest request;
  request.file = "no/such/folder/spec.yaml";
  request.text = "format: spacecraft/1\nname: x\ndrop: [a]\nhub: {mass: 1, inertia: [1, 1, 1]}\n";
  EXPECT_FALSE(load_spec(request, diagnostics_).spec);
  EXPECT_TRUE(diagnostics_.has_errors());
}

}  // namespace
}  // namespace twincraft
