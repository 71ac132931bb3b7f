// Claims about field tables: what reading a map reports, and what JSON Schema, the resolved output
// and the reference say of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compiler/schema/manual.h"
#include "compiler/schema/own_kind.h"
#include "compiler/schema/partial.h"
#include "compiler/schema/table_info.h"
#include "tests/compiler/schema_reading.h"

namespace twincraft {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

enum class Paint { kRed, kBlue };

struct AxleSpec : Written {
  Vector3d axis = Vector3d::UnitX();
  std::optional<double> angle;
  std::optional<double> turns;
  double play = 0.0;
};

struct CartSpec : Written {
  std::string name;
  double mass = 0.0;
  Paint paint = Paint::kBlue;
  std::string remark;
  std::vector<std::string> cargo;
  std::array<Schedule, 3> push;
  AxleSpec axle;
};

struct TrainSpec : Written {
  std::string name;
  std::vector<CartSpec> carts;
  std::optional<double> fast;
  std::optional<double> slow;
};

const Table<AxleSpec>& axle_table() {
  static const Table<AxleSpec> table = Table<AxleSpec>{
      "axle",
      "What a cart rolls on.",
      {
          required("axis", &AxleSpec::axis, direction(), "the wheels turn about it"),
          optional("angle", &AxleSpec::angle, maybe(quantity("rad")), "at the start"),
          optional("turns", &AxleSpec::turns, maybe(number()), "the same in turns"),
          optional("play", &AxleSpec::play, quantity("m", Range::kNotNegative), "sideways"),
      }}.exactly_one_of({"angle", "turns"});
  return table;
}

const Table<CartSpec>& cart_table() {
  static const Table<CartSpec> table{
      "cart",
      "Something to pull.",
      {
          required("name", &CartSpec::name, name(), "unique"),
          required("mass", &CartSpec::mass, quantity("kg", Range::kPositive), "without cargo"),
          optional("paint", &CartSpec::paint,
                   one_of<Paint>({{"red", Paint::kRed}, {"blue", Paint::kBlue}}), "red | blue"),
          optional("remark", &CartSpec::remark, text(), "free text"),
          optional("cargo", &CartSpec::cargo, list_of(name()), "what is on it"),
          optional("push", &CartSpec::push, schedule3("N"), "from outside"),
          required("axle", &CartSpec::axle, object(axle_table()), "the one under it"),
      }};
  return table;
}

const Table<TrainSpec>& train_table() {
  static const Table<TrainSpec> table = Table<TrainSpec>{
      "train",
      "Carts in a row.",
      {
          required("name", &TrainSpec::name, name(), "of the train"),
          required("carts", &TrainSpec::carts, list_of(object(cart_table())), "in order"),
          optional("fast", &TrainSpec::fast, maybe(number()), "speed"),
          optional("slow", &TrainSpec::slow, maybe(number()), "speed"),
      }}.at_most_one_of({"fast", "slow"});
  return table;
}

constexpr const char* kCart =
    "name: coal\nmass: 2 t\npaint: red\ncargo: [shovel]\npush: [1, [[0, 1], [2, 3]], 0]\n"
    "axle: {axis: [0, 2, 0], angle: 90 deg}\n";

template <class T>
std::vector<std::string> faults_of(const Table<T>& table, const std::string& text) {
  const Text source(text);
  Diagnostics diagnostics;
  table.read(source.root, diagnostics);
  return lines_of(diagnostics);
}

TEST(Table, FillsAStructAndKeepsDefaults) {
  const Text source(kCart);
  Diagnostics diagnostics;
  const CartSpec cart = cart_table().read(source.root, diagnostics);
  EXPECT_THAT(lines_of(diagnostics), IsEmpty());
  EXPECT_EQ(cart.name, "coal");
  EXPECT_EQ(cart.mass, 2000.0);
  EXPECT_EQ(cart.paint, Paint::kRed);
  EXPECT_EQ(cart.remark, "");
  EXPECT_EQ(cart.axle.axis, Vector3d::UnitY());
  EXPECT_EQ(cart.axle.play, 0.0);
  EXPECT_FALSE(cart.axle.turns);
}

TEST(Table, RemembersWhereEachValueWasWritten) {
  const Text source(kCart);
  Diagnostics diagnostics;
  const CartSpec cart = cart_table().read(source.root, diagnostics);
  EXPECT_TRUE(cart.has("mass"));
  EXPECT_FALSE(cart.has("remark"));
  EXPECT_EQ(cart.span_of("mass").line, 2);
  EXPECT_EQ(cart.span_of("mass").column, 7);
  EXPECT_EQ(cart.axle.span_of("play").line, 6);
  EXPECT_EQ(cart.axle.span().column, 7);
  EXPECT_EQ(CartSpec().span_of("mass").source, nullptr);
}

/// A text that counts how often one was read.
Kind<std::string> counted(int& count) {
  return own_kind<std::string>(
      {.text = "text",
       .schema = {},
       .read = [&count](const Node& node, ReadContext&) -> std::optional<std::string> {
         ++count;
         return node.scalar;
       },
       .write = [](const std::string& value) -> Json { return value; }});
}

struct LeafSpec : Written {
  std::string name, colour = "green";
};
struct BranchSpec : Written {
  std::vector<LeafSpec> leaves;
  std::optional<LeafSpec> flower;
};

TEST(Table, ReadsAgainOnlyWhatIsNotWrittenAsBefore) {
  int count = 0;
  const Table<LeafSpec> leaf{"leaf",
                             "A leaf.",
                             {required("name", &LeafSpec::name, counted(count), "its name"),
                              optional("colour", &LeafSpec::colour, counted(count), "its colour")}};
  const Table<BranchSpec> table{
      "branch",
      "A branch.",
      {optional("leaves", &BranchSpec::leaves, list_of(object(leaf)), "its leaves"),
       optional("flower", &BranchSpec::flower, maybe(object(leaf)), "its flower")}};
  const Text before("leaves: [{name: a, colour: red}, {name: b}]\nflower: {name: c, colour: blue}");
  Diagnostics diagnostics;
  const BranchSpec branch = table.read(before.root, diagnostics);
  ASSERT_EQ(count, 5);
  const auto reread = [&](const Node& node) {
    count = 0;
    return table.reread(branch, node, before.root, diagnostics);
  };

  Node node = before.root;
  EXPECT_EQ(reread(node).leaves[1].name, "b");
  EXPECT_EQ(count, 0);

  node.find("leaves")->items[0].find("colour")->scalar = "brown";
  BranchSpec changed = reread(node);
  EXPECT_EQ(count, 1);
  EXPECT_EQ(changed.leaves[0].name, "a");
  EXPECT_EQ(changed.leaves[0].colour, "brown");
  EXPECT_EQ(changed.leaves[0].node, node.find("leaves")->items.data());

  node.find("flower")->keys.pop_back();
  node.find("flower")->items.pop_back();
  changed = reread(node);
  EXPECT_EQ(changed.flower->name, "c");
  EXPECT_EQ(changed.flower->colour, "green");  // as if it had never been written
  EXPECT_EQ(count, 2);

  node.find("leaves")->items.pop_back();
  EXPECT_EQ(reread(node).leaves.size(), 1u);
  EXPECT_EQ(lines_of(diagnostics), std::vector<std::string>{});
}

TEST(Table, HintsAtTheNearestKeyOrListsThemAll) {
  EXPECT_THAT(faults_of(axle_table(), "{axis: [1, 0, 0], agnle: 1, turns: 2, colour: red}"),
              ElementsAre("1:19 SC2001 unknown key `agnle` in axle (did you mean `angle`?)",
                          "1:39 SC2001 unknown key `colour` in axle (its keys are `axis`, `angle`, "
                          "`turns` and `play`)"));
}

TEST(Table, NamesWhatAMissingKeyTakes) {
  EXPECT_THAT(faults_of(cart_table(), "name: coal\naxle: {axis: [1, 0, 0], turns: 1}\n"),
              ElementsAre("1:1 SC2002 `mass` is missing in cart `coal` (add `mass`: quantity [kg] "
                          "> 0)"));
}

TEST(Table, ReportsAllFaultsOfAllValuesInOnePass) {
  EXPECT_THAT(
      faults_of(
          cart_table(),
          "name: coal\nmass: -1\npaint: reed\ncolour: 1\naxle: {axis: [0, 0, 0], play: -1}\n"),
      ElementsAre(StartsWith("4:1 SC2001 unknown key `colour` in cart `coal`"),
                  "2:7 SC2008 `mass` of cart `coal` is `-1`, but must be positive",
                  AllOf(StartsWith("3:8 SC2009 `paint` of cart `coal` is `reed`"),
                        HasSubstr("did you mean `red`?")),
                  StartsWith("5:7 SC2002 axle has none of `angle` and `turns`"),
                  StartsWith("5:14 SC2013 `axis` of axle has length zero"),
                  "5:31 SC2008 `play` of axle is `-1`, but must not be negative"));
}

TEST(Table, CallsNestedMapsByTheirNamedOwner) {
  EXPECT_THAT(faults_of(train_table(),
                        "name: express\ncarts:\n  - {name: coal, mass: 1, axle: {axis: [0, 0, 0], "
                        "turns: 1}}\n"),
              ElementsAre(StartsWith("3:40 SC2013 `axis` of axle of cart `coal` has length zero")));
}

TEST(Table, DoesNotCallAnythingByABadName) {
  EXPECT_THAT(faults_of(cart_table(), "name: a b\nmass: 1\naxle: {axis: [1, 0, 0], turns: 1}\n"),
              ElementsAre(StartsWith("1:7 SC2010 `name` of cart is `a b`, not a name")));
}

TEST(Table, WantsAMap) {
  EXPECT_THAT(faults_of(axle_table(), "[1, 2]"),
              ElementsAre("1:1 SC2005 axle is a list, not a map (its keys are `axis`, `angle`, "
                          "`turns` and `play`)"));
  EXPECT_THAT(faults_of(cart_table(), "name: coal\nmass: 1\naxle:\n"),
              ElementsAre(HasSubstr("SC2004 `axle` of cart `coal` has no value")));
}

TEST(Group, RefusesTheSecondOfTwoExclusiveKeysAndNotesTheFirst) {
  EXPECT_THAT(faults_of(axle_table(), "{axis: [1, 0, 0], turns: 1, angle: 2}"),
              ElementsAre("1:29 SC2003 `turns` and `angle` exclude each other in axle | 1:19 "
                          "`turns` is written here"));
  EXPECT_THAT(faults_of(train_table(), "{name: a, carts: [], fast: 1, slow: 2}"),
              ElementsAre(StartsWith("1:31 SC2003 `fast` and `slow` exclude each other in train")));
}

TEST(Group, MayRequireOneOfItsKeysOrNone) {
  EXPECT_THAT(faults_of(axle_table(), "{axis: [1, 0, 0]}"),
              ElementsAre("1:1 SC2002 axle has none of `angle` and `turns` (write exactly one of "
                          "them)"));
  EXPECT_THAT(faults_of(train_table(), "{name: a, carts: []}"), IsEmpty());
}

TEST(Group, IsMadeOfOptionalFieldsOfItsTable) {
  const auto table_with_group = [](const std::string& key) {
    return Table<AxleSpec>{"axle",
                           "",
                           {required("axis", &AxleSpec::axis, direction(), ""),
                            optional("play", &AxleSpec::play, number(), "")}}
        .exactly_one_of({"play", key});
  };
  EXPECT_THROW(table_with_group("axis"), std::logic_error);
  EXPECT_THROW(table_with_group("unknown"), std::logic_error);
}

TEST(Schema, IsAClosedObjectWithRequiredKeysAndGroups) {
  const Json schema = axle_table().schema();
  EXPECT_EQ(schema["type"], "object");
  EXPECT_EQ(schema["description"], "What a cart rolls on.");
  EXPECT_EQ(schema["additionalProperties"], false);
  EXPECT_EQ(schema["required"], Json::array({"axis"}));
  EXPECT_EQ(schema["allOf"], Json::parse(R"([{"oneOf": [{"required": ["angle"]},
                                                        {"required": ["turns"]}]}])"));
  EXPECT_EQ(train_table().schema()["allOf"],
            Json::parse(R"([{"not": {"anyOf": [{"required": ["fast", "slow"]}]}}])"));
}

TEST(Schema, DescribesAQuantityWithItsUnitRangeAndDefault) {
  const Json play = axle_table().schema()["properties"]["play"];
  EXPECT_EQ(play["description"], "sideways (quantity [m] >= 0)");
  EXPECT_EQ(play["x-unit"], "m");
  EXPECT_EQ(play["default"], 0.0);
  EXPECT_EQ(play["anyOf"][0], Json::parse(R"({"type": "number", "minimum": 0})"));
  EXPECT_EQ(play["anyOf"][1]["type"], "string");
  EXPECT_TRUE(play["anyOf"][1].contains("pattern"));
}

TEST(Schema, ListsWordsAndDescribesNestedMaps) {
  const Json properties = cart_table().schema()["properties"];
  EXPECT_EQ(properties["paint"]["enum"], Json::array({"red", "blue"}));
  EXPECT_EQ(properties["axle"]["properties"]["axis"]["minItems"], 3);
  EXPECT_EQ(properties["axle"]["description"], "the one under it (axle)");
  EXPECT_EQ(properties["name"]["not"]["enum"], Json::array({"hub", "world", "com"}));
}

TEST(Default, IsTheMembersInitialiser) {
  const Json properties = cart_table().schema()["properties"];
  EXPECT_EQ(properties["paint"]["default"], "blue");
  EXPECT_EQ(properties["push"]["default"], Json::array({0.0, 0.0, 0.0}));
  for (const char* key : {"name", "mass", "remark", "cargo", "axle"})
    EXPECT_FALSE(properties[key].contains("default")) << key;
}

TEST(Resolved, IsInSiUnitsAndTableOrderWithDefaults) {
  const Text source(
      "axle: {turns: 1, axis: [2, 0, 0]}\nmass: 2 t\nname: coal\npush: {value: [1, 2, 3], unit: "
      "kN}\n");
  Diagnostics diagnostics;
  const CartSpec cart = cart_table().read(source.root, diagnostics);
  EXPECT_THAT(lines_of(diagnostics), IsEmpty());
  EXPECT_EQ(cart_table().write(cart).dump(),
            R"({"name":"coal","mass":2000.0,"paint":"blue","push":[1000.0,2000.0,3000.0],)"
            R"("axle":{"axis":[1.0,0.0,0.0],"turns":1.0,"play":0.0}})");
}

TEST(Resolved, ReadsBackAsTheSame) {
  const Text source(kCart);
  Diagnostics diagnostics;
  const Json written = cart_table().write(cart_table().read(source.root, diagnostics));
  const Text again(written.dump());
  EXPECT_EQ(cart_table().write(cart_table().read(again.root, diagnostics)), written);
  EXPECT_THAT(lines_of(diagnostics), IsEmpty());
}

TEST(Resolved, KeepsARequiredListThatIsEmpty) {
  TrainSpec train;
  train.name = "express";
  EXPECT_EQ(train_table().write(train).dump(), R"({"name":"express","carts":[]})");
}

TEST(Reference, HasASectionPerTableAndARowPerKey) {
  const std::string reference = reference_text(train_table().info());
  EXPECT_THAT(reference, StartsWith("## train\n\nCarts in a row.\n\n| key |"));
  const auto cart = reference.find("\n\n## cart\n\nSomething to pull.\n\n");
  const auto axle = reference.find("\n\n## axle\n\nWhat a cart rolls on.\n\n");
  ASSERT_NE(cart, std::string::npos);
  ASSERT_NE(axle, std::string::npos);
  EXPECT_LT(cart, axle);
  EXPECT_THAT(reference,
              HasSubstr("\n| `mass` | quantity [kg] > 0 | required | without cargo |\n"));
  EXPECT_THAT(reference,
              HasSubstr("\n| `push` | three quantities [N] or schedules | `[0, 0, 0]` |"));
  EXPECT_THAT(reference, HasSubstr("\n| `paint` | `red` or `blue` | `blue` | red \\| blue |\n"));
  EXPECT_THAT(reference, HasSubstr("\nExactly one of `angle` and `turns` is written.\n"));
  EXPECT_THAT(reference, HasSubstr("\nAt most one of `fast` and `slow` is written.\n"));
}

TEST(Partial, DemandsNothingOfASpecThatExtendsAnother) {
  const Json schema = whole_unless_extending(cart_table().schema());
  EXPECT_EQ(schema["if"], Json::parse(R"({"required": ["extends"]})"));
  EXPECT_FALSE(schema.contains("required"));
  EXPECT_FALSE(schema["properties"]["axle"].contains("required"));
  EXPECT_EQ(schema["properties"]["axle"]["type"], Json::parse(R"(["object", "null"])"));
  EXPECT_EQ(schema["additionalProperties"], false);
  const Json whole = schema["else"];
  EXPECT_EQ(whole["required"], cart_table().schema()["required"]);
  EXPECT_EQ(whole["properties"]["axle"]["type"], "object");
  EXPECT_FALSE(whole["properties"]["axle"].contains("description"));
}

}  // namespace
}  // namespace twincraft
