// Overrides: how `PATH=VALUE` is read and what it does to a tree.
#include "compiler/syntax/overrides.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compiler/diag/print.h"
#include "compiler/syntax/load.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kSpec = R"(
hub: {mass: 600 kg, inertia: [400, 380, 360]}
wheels:
  - {name: rw_x, torque: 0, axis: [1, 0, 0]}
  - {name: rw_y, torque: 0}
panels: []
simulation: {step: 0.02}
environment:
)";

class Overrides : public testing::Test {
 protected:
  void SetUp() override {
    auto root = parse(sources_.add("t.yaml", kSpec), diagnostics_);
    ASSERT_TRUE(root);
    root_ = std::move(*root);
  }

  /// Parses and applies; false as well when parsing failed.
  bool set(std::string_view text) {
    const auto parsed = parse_override(text, sources_, diagnostics_);
    return parsed && apply(*parsed, root_, diagnostics_);
  }

  const Node* at(std::initializer_list<std::string_view> keys) const {
    const Node* node = &root_;
    for (const std::string_view key : keys) node = node != nullptr ? node->find(key) : nullptr;
    return node;
  }

  const Node& wheel(std::size_t index) const { return root_.find("wheels")->items.at(index); }

  std::string text() const { return to_text(diagnostics_, {}); }

  Sources sources_;
  Diagnostics diagnostics_;
  Node root_;
};

TEST_F(Overrides, ReplaceAValue) {
  EXPECT_TRUE(set("simulation.step=40 s"));
  EXPECT_EQ(at({"simulation", "step"})->scalar, "40 s");
  EXPECT_TRUE(set("hub.inertia=[1, 2, 3]"));
  EXPECT_EQ(at({"hub", "inertia"})->items[2].scalar, "3");
  EXPECT_EQ(text(), "");
}

TEST_F(Overrides, ReplaceAMapAsAWhole) {
  EXPECT_TRUE(set("simulation={duration: 5 s}"));
  EXPECT_EQ(at({"simulation", "step"}), nullptr);
  EXPECT_EQ(at({"simulation", "duration"})->scalar, "5 s");
}

TEST_F(Overrides, MakeMissingMapsOnTheWay) {
  EXPECT_TRUE(set("engines.mujoco.frame=inertial"));
  EXPECT_EQ(at({"engines", "mujoco", "frame"})->scalar, "inertial");
  EXPECT_TRUE(set("environment.gravity.mu=1"));
  EXPECT_EQ(at({"environment", "gravity", "mu"})->scalar, "1");
}

TEST_F(Overrides, AddressListMembersByName) {
  EXPECT_TRUE(set("wheels.rw_y.torque=10 mN m"));
  EXPECT_EQ(wheel(0).find("torque")->scalar, "0");
  EXPECT_EQ(wheel(1).find("torque")->scalar, "10 mN m");
}

TEST_F(Overrides, AddressAllListMembersByAStar) {
  EXPECT_TRUE(set("wheels.*.speed=1 rpm"));
  EXPECT_EQ(wheel(0).find("speed")->scalar, "1 rpm");
  EXPECT_EQ(wheel(1).find("speed")->scalar, "1 rpm");
}

TEST_F(Overrides, SplitAtTheFirstEqualsSign) {
  EXPECT_TRUE(set("description=a=b"));
  EXPECT_EQ(at({"description"})->scalar, "a=b");
}

TEST_F(Overrides, RemoveAKeyByANullValue) {
  for (const char* text : {"hub.mass=null", "hub.inertia=~", "simulation="}) {
    EXPECT_TRUE(set(text)) << text;
  }
  EXPECT_EQ(at({"hub", "mass"}), nullptr);
  EXPECT_EQ(at({"hub", "inertia"}), nullptr);
  EXPECT_EQ(at({"simulation"}), nullptr);
  EXPECT_NE(at({"hub"}), nullptr);
}

TEST_F(Overrides, RemoveListMembers) {
  EXPECT_TRUE(set("wheels.rw_x=null"));
  ASSERT_EQ(root_.find("wheels")->items.size(), 1u);
  EXPECT_EQ(wheel(0).find("name")->scalar, "rw_y");
  EXPECT_TRUE(set("wheels.*=null"));
  EXPECT_TRUE(root_.find("wheels")->items.empty());
}

TEST_F(Overrides, KeepTheNameOfAReplacedMember) {
  EXPECT_TRUE(set("wheels.rw_x={torque: 5}"));
  EXPECT_EQ(wheel(0).find("name")->scalar, "rw_x");
  EXPECT_EQ(wheel(0).find("axis"), nullptr);
  EXPECT_TRUE(set("wheels.rw_x={name: other}"));
  EXPECT_EQ(wheel(0).find("name")->scalar, "other");
}

TEST_F(Overrides, PointAtTheirOwnText) {
  ASSERT_TRUE(set("simulation.step=[1, 2]"));
  const Span span = at({"simulation", "step"})->items[1].span;
  EXPECT_EQ(span.source->name(), "--set simulation.step");
  EXPECT_EQ(span.source->line(1), "simulation.step=[1, 2]");
  EXPECT_EQ(span.column, 21);
}

TEST_F(Overrides, ReportUnknownMembersWithTheNearest) {
  EXPECT_FALSE(set("wheels.rw_xx.torque=1"));
  EXPECT_EQ(text(),
            "--set wheels.rw_xx.torque:1:8: error[SC1502]: `wheels` has no member named `rw_xx`\n"
            "    1 | wheels.rw_xx.torque=1\n"
            "      |        ^~~~~\n"
            "  hint: did you mean `rw_x`?\n"
            "1 error\n");
}

TEST_F(Overrides, ListTheMembersWhenNoneIsNear) {
  EXPECT_FALSE(set("wheels.front.torque=1"));
  EXPECT_THAT(text(), HasSubstr("its members are `rw_x`, `rw_y`"));
}

TEST_F(Overrides, ReportAStarWithoutMembers) {
  EXPECT_FALSE(set("panels.*.segments=4"));
  EXPECT_THAT(text(), HasSubstr("`panels` has no members"));
  EXPECT_FALSE(set("hub.*.mass=4"));
  EXPECT_THAT(text(), HasSubstr("`hub` is a map"));
  EXPECT_FALSE(set("tanks.*.mass=4"));
  EXPECT_THAT(text(), HasSubstr("`tanks` has no members"));
  EXPECT_EQ(diagnostics_.error_count(), 3u);
}

TEST_F(Overrides, ReportPathsThroughValues) {
  EXPECT_FALSE(set("hub.mass.unit=kg"));
  EXPECT_THAT(text(), HasSubstr("`hub.mass` is `600 kg`, which has no parts"));
  EXPECT_FALSE(set("hub.inertia.x=1"));
  EXPECT_THAT(text(), HasSubstr("`hub.inertia` is a list without named members"));
}

TEST_F(Overrides, ReportTheRemovalOfWhatIsNotThere) {
  EXPECT_FALSE(set("whels=null"));
  EXPECT_THAT(text(), HasSubstr("the spec has no `whels` to remove"));
  EXPECT_THAT(text(), HasSubstr("did you mean `wheels`?"));
  EXPECT_FALSE(set("nothing.at.all=~"));
  EXPECT_EQ(at({"nothing"}), nullptr);
}

TEST_F(Overrides, RefuseWhatIsNotPathAndValue) {
  for (const char* text : {"", "=", "=5", "simulation.step", "a..b=1", ".a=1", "a.=1", "a b=1",
                           "wheels.0.torque=1", "wheels[0]=1", "a.**=1", "a.-b=1", " =1"}) {
    const std::size_t before = diagnostics_.error_count();
    EXPECT_FALSE(set(text)) << text;
    EXPECT_GT(diagnostics_.error_count(), before) << text;
    EXPECT_EQ(diagnostics_.all().back().code, Code::kOverrideForm) << text;
  }
}

TEST_F(Overrides, PointAtTheBadStep) {
  EXPECT_FALSE(set("wheels.0.torque=1"));
  EXPECT_THAT(text(), StartsWith("--set wheels.0.torque:1:8: error[SC1501]: `0` is a number"));
}

TEST_F(Overrides, ReportFaultsOfTheValueAtItsColumn) {
  EXPECT_FALSE(set("hub.inertia=[1, 2"));
  EXPECT_THAT(text(), StartsWith("--set hub.inertia:1:13: error[SC1015]"));
  EXPECT_FALSE(set("hub.mass=*x"));
  EXPECT_FALSE(set("hub.mass=#5"));
  EXPECT_FALSE(set("hub.mass={a: 1, a: 2}"));
  EXPECT_EQ(diagnostics_.error_count(), 4u);
}

TEST_F(Overrides, AllowBlanksAroundPathAndValue) {
  EXPECT_TRUE(set(" simulation.step = 5 s "));
  EXPECT_EQ(at({"simulation", "step"})->scalar, "5 s");
}

TEST_F(Overrides, RefuseAPathWithoutEnd) {
  std::string path = "a";
  for (int i = 0; i < 1000; ++i) path += ".a";
  EXPECT_FALSE(set(path + "=1"));
  EXPECT_TRUE(diagnostics_.has_errors());
}

}  // namespace
}  // namespace twincraft
