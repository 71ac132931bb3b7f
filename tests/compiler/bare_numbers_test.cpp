// Plain numbers that are likely meant in another unit are read as they stand, and said aloud.
#include "compiler/schema/bare_numbers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/compiler/schema_reading.h"

namespace twincraft {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// The one warning about `text`, whose value is read all the same.
template <class V>
std::string warning_of(const Kind<V>& kind, const std::string& text) {
  const Reading<V> reading = read(kind, text);
  EXPECT_TRUE(reading.value.has_value()) << text;
  EXPECT_EQ(reading.faults.size(), 1u) << text;
  return reading.faults.empty() ? std::string() : reading.faults.front();
}

TEST(BareNumbers, AnAngleOfMoreThanATurnLooksLikeDegrees) {
  EXPECT_EQ(warning_of(quantity("rad"), "45"),
            "1:1 SC2018 `it` has the plain number `45`: 45 rad is 7.16 turns (write `45 deg` if "
            "that is meant, else `45 rad`)");
  for (const char* text : {"-30", "347.8", "6.5", "5", "\"90\"", "1.0e3"})
    EXPECT_THAT(warning_of(quantity("rad"), text), StartsWith("1:1 SC2018")) << text;
}

TEST(BareNumbers, AnAngleThatIsUsualOrHasItsUnitIsNotQuestioned) {
  for (const char* text :
       {"0", "0.2", "-1.5707963", "3", "4.712", "6.283185307", "45 deg", "45 rad"})
    EXPECT_THAT(read(quantity("rad"), text).faults, IsEmpty()) << text;
  EXPECT_THAT(read(quantity("m"), "45").faults, IsEmpty());
}

TEST(BareNumbers, RatesLookLikeDegreesPerSecondAndSpeedsOfWheelsLikeRpm) {
  EXPECT_THAT(warning_of(quantity("rad/s"), "10"),
              AllOf(HasSubstr("10 rad/s is 95.493 rpm"), HasSubstr("write `10 deg/s`")));
  const Kind<double> speed = quantity("rad/s", Range::kAny, kUsualWheelSpeed);
  EXPECT_THAT(warning_of(speed, "6000"),
              AllOf(HasSubstr("6000 rad/s is 57295.8 rpm"), HasSubstr("write `6000 rpm`")));
  for (const char* text : {"0", "628.3", "-100", "6000 rpm", "6000 rad/s"})
    EXPECT_THAT(read(speed, text).faults, IsEmpty()) << text;
}

TEST(BareNumbers, OneWarningIsEnoughForAList) {
  EXPECT_THAT(warning_of(vector3("rad"), "[0.5, -20, 50]"), StartsWith("1:7 SC2018"));
  EXPECT_THAT(warning_of(one_or_more_quantities("rad"), "[45, 30]"), StartsWith("1:2 SC2018"));
  EXPECT_THAT(warning_of(one_or_more_quantities("rad"), "45"), StartsWith("1:1 SC2018"));
  EXPECT_THAT(warning_of(quantities("rad", 2), "[10, 20]"), StartsWith("1:2 SC2018"));
  EXPECT_THAT(warning_of(vector3("rad/s"), "[10, 0, 0]"), StartsWith("1:2 SC2018"));
}

TEST(MixedUnits, AreSaidAtTheFirstEntryWithoutAUnit) {
  EXPECT_EQ(
      warning_of(vector3("m"), "[10 mm, 5, 3]"),
      "1:9 SC2017 `it` mixes `10 mm` with the plain number `5`, which is 5 m (write `5 mm` if "
      "that is meant, else `5 m`)");
  EXPECT_THAT(warning_of(vector3("m"), "[5, 3, 10 mm]"), StartsWith("1:2 SC2017"));
  EXPECT_THAT(warning_of(inertia(), "[1.0e6 g cm2, 1.0e6, 1.0e6]"), StartsWith("1:15 SC2017"));
  EXPECT_THAT(warning_of(inertia(), "[[4 g m2, 1, 0], [1, 4 g m2, 0], [0, 0, 4 g m2]]"),
              StartsWith("1:11 SC2017"));
  EXPECT_THAT(warning_of(vector3("rad"), "[30 deg, 20, 50]"), StartsWith("1:10 SC2017"));
  EXPECT_THAT(warning_of(one_or_more_quantities("rad"), "[5 deg, 3]"), StartsWith("1:9 SC2017"));
}

TEST(MixedUnits, AreSaidOfSchedulesAndIntervals) {
  EXPECT_THAT(warning_of(schedule("N m"), "[[0, 10 mN m], [5, 20]]"), StartsWith("1:20 SC2017"));
  EXPECT_THAT(warning_of(schedule("N m"), "[[1 min, 1], [90, 2]]"), StartsWith("1:15 SC2017"));
  EXPECT_THAT(warning_of(schedule3("N"), "[5 mN, 3, 0]"), StartsWith("1:8 SC2017"));
  EXPECT_THAT(warning_of(schedule3("N"), "[[[0, 5 mN]], 3, 0]"), StartsWith("1:15 SC2017"));
  EXPECT_THAT(warning_of(intervals(), "[[0, 5 min], [400, 500]]"), StartsWith("1:15 SC2017"));
}

TEST(MixedUnits, AreFineWhereTheyMeanTheSame) {
  EXPECT_THAT(read(vector3("m"), "[10 mm, 0, 0]").faults, IsEmpty());
  EXPECT_THAT(read(vector3("m"), "[1 m, 2, 3]").faults, IsEmpty());
  EXPECT_THAT(read(vector3("m"), "{value: [10, 5, 3], unit: mm}").faults, IsEmpty());
  EXPECT_THAT(read(schedule("N m"), "[[0, 10 mN m], [5 s, 0]]").faults, IsEmpty());
  EXPECT_THAT(read(schedule("N m"), "[[0, 0.01], [60, 0]]").faults, IsEmpty());
}

}  // namespace
}  // namespace twincraft
