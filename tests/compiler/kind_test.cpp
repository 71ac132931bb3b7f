// Claims about single values: what each kind accepts, and what it says of what it does not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "compiler/schema/table_info.h"
#include "tests/compiler/schema_reading.h"

namespace twincraft {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

enum class Pace { kWalk, kTrot, kGallop };

Kind<Pace> pace() {
  return one_of<Pace>({{"walk", Pace::kWalk}, {"trot", Pace::kTrot}, {"gallop", Pace::kGallop}});
}

/// The one fault that reading `text` reports; nothing may be read.
template <class V>
std::string fault_of(const Kind<V>& kind, const std::string& text) {
  const Reading<V> reading = read(kind, text);
  EXPECT_FALSE(reading.value.has_value()) << text;
  EXPECT_THAT(reading.faults, SizeIs(1)) << text;
  return reading.faults.empty() ? std::string() : reading.faults.front();
}

TEST(QuantityKind, TakesPlainSiNumbersAndUnits) {
  EXPECT_EQ(read(quantity("kg"), "600").value, 600.0);
  EXPECT_EQ(read(quantity("kg"), "600 kg").value, 600.0);
  EXPECT_EQ(read(quantity("m"), "7000 km").value, 7.0e6);
  EXPECT_EQ(read(quantity("kg"), "\"600\"").value, 600.0);
}

TEST(QuantityKind, PassesOnWhatUnitsSayOfAWrongDimension) {
  EXPECT_EQ(fault_of(quantity("kg"), "5 s"),
            "1:1 SC2007 `it`: `5 s` is a time, a mass [kg] is expected");
  EXPECT_EQ(fault_of(quantity("kg"), "kg"),
            "1:1 SC2007 `it`: `kg` is a unit without its number (write the number before it, such "
            "as `1 kg`)");
}

TEST(QuantityKind, RefusesWhatIsNoDecimalNumber) {
  for (const char* text : {"010", "0x10", ".nan", ".inf", "1_000", "\"1,5\"", "1e400", "12:30"})
    EXPECT_THAT(fault_of(quantity("kg"), text), StartsWith("1:1 SC2007 `it`: ")) << text;
}

TEST(QuantityKind, KeepsItsRange) {
  EXPECT_EQ(read(quantity("kg", Range::kNotNegative), "0").value, 0.0);
  EXPECT_EQ(fault_of(quantity("kg", Range::kNotNegative), "-1 kg"),
            "1:1 SC2008 `it` is `-1 kg`, but must not be negative");
  EXPECT_EQ(fault_of(quantity("kg", Range::kPositive), "0"),
            "1:1 SC2008 `it` is `0`, but must be positive");
}

TEST(QuantityKind, IsANumberThatTheEnginesCanComputeWith) {
  EXPECT_EQ(read(quantity("m", Range::kPositive), "1e-30").value, 1e-30);
  EXPECT_EQ(read(quantity("m"), "-1e30").value, -1e30);
  EXPECT_EQ(read(quantity("N m/rad", Range::kNotNegative), "1e-200").value, 1e-200);
  EXPECT_THAT(fault_of(quantity("m", Range::kPositive), "1e-31"),
              StartsWith("1:1 SC2008 `it` is `1e-31`, but must be at least 1e-30 in SI units"));
  EXPECT_THAT(fault_of(quantity("m", Range::kPositive), "1e-25 um"),
              StartsWith("1:1 SC2008 `it` is `1e-25 um`, but must be at least 1e-30"));
  EXPECT_THAT(fault_of(quantity("rad/s"), "-2e30"),
              StartsWith("1:1 SC2008 `it` is `-2e30`, but must be at most 1e+30 in SI units"));
  EXPECT_THAT(fault_of(vector3("m"), "[0, 1e-200, 1e31]"),
              StartsWith("1:13 SC2008 item 3 of `it` is `1e31`, but must be at most 1e+30"));
  EXPECT_THAT(fault_of(inertia(), "[1e300, 1, 1]"), HasSubstr("SC2008 item 1 of `it`"));
  EXPECT_THAT(fault_of(schedule("N m"), "[[0, 1], [1 s, 1e40]]"), HasSubstr("SC2008"));
}

TEST(QuantityKind, ReadsNegativeZeroAsZero) {
  const auto value = read(quantity("m"), "-0.0").value;
  ASSERT_TRUE(value);
  EXPECT_FALSE(std::signbit(*value));
}

TEST(QuantityKind, SaysWhatItFoundInsteadOfAScalar) {
  EXPECT_EQ(fault_of(quantity("kg"), "[1, 2]"),
            "1:1 SC2005 `it` is a list, not a quantity [kg] (write for example `12 kg`)");
  EXPECT_EQ(fault_of(quantity("kg"), "null"),
            "1:1 SC2004 `it` has no value (write a quantity [kg], or delete it)");
}

TEST(NumberKind, HasNoUnit) {
  EXPECT_EQ(read(number(), "1.0e-9").value, 1.0e-9);
  EXPECT_THAT(fault_of(number(), "5 kg"), StartsWith("1:1 SC2006 `it`: "));
  EXPECT_EQ(fault_of(number(Range::kPositive), "-2"),
            "1:1 SC2008 `it` is `-2`, but must be positive");
}

TEST(IntegerKind, TakesWholeNumbersInRange) {
  EXPECT_EQ(read(integer(1, 64), "32").value, 32);
  EXPECT_EQ(fault_of(integer(1, 64), "1.5"), "1:1 SC2005 `it` is `1.5`, not a whole number");
  EXPECT_EQ(fault_of(integer(1, 64), "0"),
            "1:1 SC2008 `it` is `0`, but must be a whole number from 1 to 64");
  EXPECT_EQ(fault_of(integer(1, std::numeric_limits<int>::max()), "1e300"),
            "1:1 SC2008 `it` is `1e300`, but must be a whole number >= 1");
  EXPECT_THAT(fault_of(integer(1, 64), "010"), StartsWith("1:1 SC2006 `it`: "));
}

TEST(BooleanKind, TakesTrueAndFalseAlone) {
  EXPECT_EQ(read(boolean(), "true").value, true);
  EXPECT_EQ(read(boolean(), "false").value, false);
  EXPECT_EQ(fault_of(boolean(), "yes"),
            "1:1 SC2005 `it` is `yes`, not `true` or `false` (write `true`)");
  EXPECT_EQ(fault_of(boolean(), "off"),
            "1:1 SC2005 `it` is `off`, not `true` or `false` (write `false`)");
  EXPECT_EQ(fault_of(boolean(), "\"true\""),
            "1:1 SC2005 `it` is `true`, not `true` or `false` (write `true` without quotes)");
  EXPECT_EQ(fault_of(boolean(), "maybe"), "1:1 SC2005 `it` is `maybe`, not `true` or `false`");
}

TEST(TextKind, TakesAnyScalar) {
  EXPECT_EQ(read(text(), "free text: no").faults.size(), 1u);
  EXPECT_EQ(read(text(), "'free text: yes'").value, "free text: yes");
  EXPECT_EQ(fault_of(text(), "{a: 1}"), "1:1 SC2005 `it` is a map, not a text");
}

TEST(NameKind, TakesPlainNamesAlone) {
  const std::string rule = " (a name is a letter, then letters, digits, `_` and `-`)";
  EXPECT_EQ(read(name(), "rw_x-2").value, "rw_x-2");
  EXPECT_EQ(read(name(), "\"rw_x\"").value, "rw_x");
  EXPECT_EQ(fault_of(name(), "2x"), "1:1 SC2010 `it` is `2x`, not a name" + rule);
  EXPECT_EQ(fault_of(name(), "a.b"), "1:1 SC2010 `it` is `a.b`, not a name" + rule);
  EXPECT_EQ(fault_of(name(), "caf\xC3\xA9"), "1:1 SC2010 `it` is `caf\xC3\xA9`, not a name" + rule);
  EXPECT_EQ(fault_of(name(), "''"), "1:1 SC2010 `it` is empty" + rule);
  EXPECT_EQ(fault_of(name(), std::string(65, 'a')),
            "1:1 SC2010 `it` is 65 characters long, but may have 64");
  EXPECT_TRUE(read(name(), std::string(64, 'a')).value);
}

TEST(NameKind, LeavesReservedWordsToReferences) {
  for (const std::string word : {"hub", "world", "com"}) {
    EXPECT_EQ(fault_of(name(), word), "1:1 SC2010 `it` is `" + word +
                                          "`, a reserved word (`hub`, `world` and `com` already "
                                          "have a meaning)");
    EXPECT_EQ(read(reference_to("mount"), word).value, word);
  }
  EXPECT_THAT(fault_of(reference_to("tank"), "a b"),
              StartsWith("1:1 SC2010 `it` is `a b`, not a tank name"));
}

TEST(WordKind, KnowsItsWordsAndTheNearestOne) {
  EXPECT_EQ(read(pace(), "trot").value, Pace::kTrot);
  EXPECT_EQ(read(pace(), "'walk'").value, Pace::kWalk);
  EXPECT_EQ(fault_of(pace(), "gallopp"),
            "1:1 SC2009 `it` is `gallopp`, not `walk`, `trot` or `gallop` (did you mean "
            "`gallop`?)");
  EXPECT_EQ(fault_of(pace(), "swim-along"),
            "1:1 SC2009 `it` is `swim-along`, not `walk`, `trot` or `gallop`");
}

TEST(VectorKind, TakesAListOrOneUnitForAll) {
  EXPECT_EQ(read(vector3("m"), "[1, 20 mm, 0]").value, Vector3d(1.0, 0.02, 0.0));
  EXPECT_EQ(read(vector3("m"), "{value: [30, 0, 1], unit: mm}").value,
            read(vector3("m"), "[30 mm, 0, 1 mm]").value);
  EXPECT_THAT(fault_of(vector3("m"), "{value: [0, 1e308, 0], unit: km}"),
              StartsWith("1:13 SC2007 item 2 of `it`: "));
}

TEST(VectorKind, PointsAtEachBadEntry) {
  EXPECT_THAT(read(vector3("m"), "[1 s, 0, oops]").faults,
              ElementsAre(StartsWith("1:2 SC2007 item 1 of `it`: "),
                          StartsWith("1:10 SC2007 item 3 of `it`: ")));
  EXPECT_EQ(fault_of(vector3("m"), "[1, 2]"),
            "1:1 SC2011 `it` has 2 items, but must have exactly 3");
  EXPECT_EQ(fault_of(vector3("m"), "[1, 2, 3, 4]"),
            "1:1 SC2012 `it` has 4 items, but must have exactly 3");
  EXPECT_EQ(fault_of(vector3("m"), "0.8"),
            "1:1 SC2005 `it` is `0.8`, not three quantities [m] (lists are written `[.., ..]`)");
}

TEST(VectorKind, ChecksTheMapWithOneUnit) {
  EXPECT_EQ(fault_of(vector3("m"), "{value: [1, 0, 0], unit: s}"),
            "1:26 SC2007 `it`: `s` is a time, a length [m] is expected");
  EXPECT_THAT(fault_of(vector3("m"), "{value: [1, 0, 0], unit: ''}"),
              StartsWith("1:26 SC2007 `it`: "));
  EXPECT_THAT(fault_of(vector3("m"), "{value: [1 mm, 0, 0], unit: mm}"),
              StartsWith("1:10 SC2006 item 1 of `it`: "));
  EXPECT_THAT(read(vector3("m"), "{value: [1, 0, 0], unti: mm}").faults,
              ElementsAre("1:20 SC2001 unknown key `unti` in vector (did you mean `unit`?)",
                          "1:1 SC2002 `unit` is missing in vector (add `unit`: unit, such as mm)"));
  EXPECT_EQ(fault_of(vector3("m"), "{value: [1, 0, 0], unit: [mm]}"),
            "1:26 SC2005 `unit` of vector is a list, not a unit (write for example `mm`)");
}

TEST(DirectionKind, IsNormalised) {
  EXPECT_EQ(read(direction(), "[0, -2, 0]").value, Vector3d(0.0, -1.0, 0.0));
  EXPECT_NEAR((*read(direction(), "[1e200, 1e200, 0]").value).norm(), 1.0, 1e-15);
  EXPECT_EQ(read(direction(), "[0, 0, 1e-300]").value, Vector3d(0.0, 0.0, 1.0));
  EXPECT_EQ(fault_of(direction(), "[0, 0, 0]"),
            "1:1 SC2013 `it` has length zero (write a direction such as `[0, 0, 1]`; its length "
            "does not matter)");
}

TEST(InertiaKind, TakesMomentsOrASymmetricTensor) {
  const Matrix3d diagonal = Vector3d(400.0, 380.0, 360.0).asDiagonal();
  EXPECT_EQ(read(inertia(), "[400, 380 kg m2, 360]").value, diagonal);
  EXPECT_EQ(read(inertia(), "[[400, 0, 0], [0, 380, 0], [0, 0, 360]]").value, diagonal);
  Matrix3d full;
  full << 4.0, 0.5, 0.0, 0.5, 3.0, 0.0, 0.0, 0.0, 2.0;
  EXPECT_EQ(read(inertia(), "{value: [[4, 0.5, 0], [0.5, 3, 0], [0, 0, 2]], unit: kg m2}").value,
            full);
}

TEST(InertiaKind, ShowsBothEntriesThatDiffer) {
  EXPECT_EQ(fault_of(inertia(), "[[4, 1, 0], [2, 3, 0], [0, 0, 2]]"),
            "1:14 SC2014 `it` is not symmetric: row 2 column 1 is `2` | 1:6 row 1 column 2 is `1`");
  EXPECT_EQ(fault_of(inertia(), "[[4, 1, 0], 3, [0, 0, 2]]"),
            "1:13 SC2005 row 2 of `it` is `3`, not a row of three numbers (lists are written "
            "`[.., ..]`)");
}

TEST(InertiaKind, AveragesAnAsymmetryOfRounding) {
  const auto tensor = read(inertia(), "[[4, 1, 0], [1.000000002, 3, 0], [0, 0, 2]]").value;
  ASSERT_TRUE(tensor);
  EXPECT_EQ((*tensor)(0, 1), (*tensor)(1, 0));
  EXPECT_DOUBLE_EQ((*tensor)(0, 1), 1.000000001);
}

TEST(MatrixKind, TakesThreeRows) {
  const auto matrix = read(matrix3(), "[[0, 1, 0], [-1, 0, 0], [0, 0, 1]]").value;
  ASSERT_TRUE(matrix);
  EXPECT_EQ((*matrix)(0, 1), 1.0);
  EXPECT_EQ((*matrix)(1, 0), -1.0);
  EXPECT_EQ(fault_of(matrix3(), "[[0, 1, 0], [-1, 0], [0, 0, 1]]"),
            "1:13 SC2011 row 2 of `it` has 2 items, but must have exactly 3");
}

TEST(ScheduleKind, TakesAValueOrPoints) {
  const auto constant = read(schedule("N m"), "0.01 N m").value;
  ASSERT_TRUE(constant);
  EXPECT_EQ(constant->at(-5.0), 0.01);
  const auto steps = read(schedule("N m"), "[[1 min, 0.01], [2 min, -0.01]]").value;
  ASSERT_TRUE(steps);
  EXPECT_EQ(steps->at(59.0), 0.0);
  EXPECT_EQ(steps->at(60.0), 0.01);
  EXPECT_EQ(steps->at(120.0), -0.01);
}

TEST(ScheduleKind, WantsIncreasingTimes) {
  EXPECT_EQ(fault_of(schedule("N"), "[[0, 1], [40, 2], [40, 3]]"),
            "1:20 SC2015 item 3 of `it` is at 40 s, not after the point before it | 1:11 the point "
            "before it is here");
  EXPECT_EQ(fault_of(schedule("N"), "[]"), "1:1 SC2011 `it` has 0 items, but must have at least 1");
  EXPECT_EQ(fault_of(schedule("N"), "[[0, 1, 2]]"),
            "1:2 SC2012 item 1 of `it` has 3 items, but must have exactly 2");
  EXPECT_EQ(fault_of(schedule("N", Range::kNotNegative), "[[0, 1], [1, -1 N]]"),
            "1:14 SC2008 value of item 2 of `it` is `-1 N`, but must not be negative");
}

TEST(Schedule3Kind, SchedulesEachComponent) {
  const auto force = read(schedule3("N"), "[[[0, 1], [5, 0]], 2, 0]").value;
  ASSERT_TRUE(force);
  EXPECT_EQ((*force)[0].at(6.0), 0.0);
  EXPECT_EQ((*force)[1].at(6.0), 2.0);
  const auto scaled = read(schedule3("N"), "{value: [5, [[0, 1]], 0], unit: mN}").value;
  ASSERT_TRUE(scaled);
  EXPECT_EQ((*scaled)[0].at(0.0), 0.005);
  EXPECT_EQ((*scaled)[1].at(0.0), 0.001);
  EXPECT_EQ(fault_of(schedule3("N"), "[1, 2]"),
            "1:1 SC2011 `it` has 2 items, but must have exactly 3");
}

TEST(IntervalsKind, FollowOneAnother) {
  const auto during = read(intervals(), "[[0 s, 15 min], [900, 1000]]").value;
  ASSERT_TRUE(during);
  ASSERT_THAT(*during, SizeIs(2));
  EXPECT_EQ(during->front().end, 900.0);
  EXPECT_EQ(fault_of(intervals(), "[[5, 5]]"),
            "1:6 SC2016 item 1 of `it` ends at 5 s, not after its start at 5 s");
  EXPECT_EQ(fault_of(intervals(), "[[0, 10], [9, 20]]"),
            "1:12 SC2016 item 2 of `it` starts at 9 s, before the one before it ends | 1:6 the one "
            "before it ends here");
  EXPECT_THAT(read(intervals(), "[0, 900]").faults,
              ElementsAre(StartsWith("1:2 SC2005 item 1 of `it` is `0`, not an interval"),
                          StartsWith("1:5 SC2005 item 2 of `it` is `900`, not an interval")));
}

TEST(ListKind, ReportsEveryBadItem) {
  EXPECT_EQ(read(list_of(pace()), "[walk, trot]").value, (std::vector{Pace::kWalk, Pace::kTrot}));
  EXPECT_THAT(read(list_of(pace()), "[walkk, trot, null]").faults,
              ElementsAre(AllOf(StartsWith("1:2 SC2009 item 1 of `it`"), HasSubstr("`walk`?")),
                          StartsWith("1:15 SC2004 item 3 of `it` has no value")));
  EXPECT_EQ(fault_of(list_of(pace(), 2, 4), "[walk]"),
            "1:1 SC2011 `it` has 1 item, but must have from 2 to 4");
}

TEST(OneOrListKind, MakesAListOfOne) {
  EXPECT_EQ(read(one_or_list(number()), "3").value, std::vector{3.0});
  EXPECT_EQ(read(one_or_list(number()), "[3, 4]").value, (std::vector{3.0, 4.0}));
  EXPECT_THAT(read(one_or_list(number()), "[]").faults, SizeIs(1));
}

TEST(EitherKind, TellsTheTwoApartByShape) {
  const auto point = either(is_scalar, pace(), vector3("m"));
  EXPECT_EQ(std::get<0>(*read(point, "trot").value), Pace::kTrot);
  EXPECT_EQ(std::get<1>(*read(point, "[1, 2, 3]").value), Vector3d(1.0, 2.0, 3.0));
  EXPECT_THAT(fault_of(point, "[1, 2]"), StartsWith("1:1 SC2011"));
  EXPECT_EQ(point.write(Pace::kWalk), Json("walk"));
  EXPECT_EQ(point.write(Vector3d(1.0, 2.0, 3.0)), Json::array({1.0, 2.0, 3.0}));
}

TEST(MaybeKind, WritesNothingForNothing) {
  EXPECT_EQ(**read(maybe(number()), "4").value, 4.0);
  EXPECT_FALSE(read(maybe(number()), "[]").value.has_value());
  EXPECT_TRUE(maybe(number()).write(std::nullopt).is_null());
}

/// What is written, read again and written once more is the same.
template <class V>
void expect_round_trip(const Kind<V>& kind, const std::string& text) {
  const Reading<V> first = read(kind, text);
  ASSERT_TRUE(first.value) << text;
  const Json written = kind.write(*first.value);
  const Reading<V> second = read(kind, written.dump());
  EXPECT_THAT(second.faults, IsEmpty()) << written;
  ASSERT_TRUE(second.value) << written;
  EXPECT_EQ(kind.write(*second.value), written);
}

TEST(EveryKind, ReadsBackWhatItWrites) {
  expect_round_trip(quantity("rad"), "12.3 deg");
  expect_round_trip(number(), "0.1");
  expect_round_trip(integer(0, 9), "7");
  expect_round_trip(boolean(), "true");
  expect_round_trip(text(), "'a: \"b\"'");
  expect_round_trip(name(), "rw_x");
  expect_round_trip(vector3("m"), "{value: [1, 2.5, 3], unit: mm}");
  expect_round_trip(direction(), "[1, 2, -3]");
  expect_round_trip(direction(), "[0.1, 0.7, 0.3]");
  expect_round_trip(inertia(), "[3, 2, 1.5]");
  expect_round_trip(inertia(), "[[4, 0.1, 0], [0.1, 3, 0], [0, 0, 2]]");
  expect_round_trip(matrix3(), "[[0, 1, 0], [-1, 0, 0], [0, 0, 1]]");
  expect_round_trip(schedule("N"), "3");
  expect_round_trip(schedule("N"), "[[0, 1], [1 min, 2]]");
  expect_round_trip(schedule3("N"), "[1, 0, [[1, 2]]]");
  expect_round_trip(intervals(), "[[0, 1], [1, 2.5]]");
  expect_round_trip(one_or_list(number()), "[1, 2]");
  expect_round_trip(pace(), "gallop");
}

}  // namespace
}  // namespace twincraft
