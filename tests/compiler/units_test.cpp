// Quantities: what a number is, what a unit is, which dimension fits, and how exactly it converts.
#include "compiler/units/units.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <stdexcept>
#include <thread>
#include <vector>

#include "compiler/units/unit_database.h"

namespace twincraft {
namespace {

using std::numbers::pi;
using testing::AllOf;
using testing::HasSubstr;

double value_of(std::string_view text, SiUnit si) {
  const Quantity quantity = parse_quantity(text, si);
  EXPECT_EQ(quantity.error, "") << text;
  return quantity.value;
}

std::string error_of(std::string_view text, SiUnit si) {
  const Quantity quantity = parse_quantity(text, si);
  EXPECT_NE(quantity.error, "") << text << " was read as " << quantity.value;
  return quantity.error;
}

TEST(Numbers, ArePlainDecimals) {
  EXPECT_EQ(value_of("5", "m"), 5.0);
  EXPECT_EQ(value_of("+5", "m"), 5.0);
  EXPECT_EQ(value_of("-5.25e-3", "m"), -5.25e-3);
  EXPECT_EQ(value_of("1E+3", "m"), 1000.0);
  EXPECT_EQ(value_of(".5", "m"), 0.5);
  EXPECT_EQ(value_of("5.", "m"), 5.0);
  EXPECT_EQ(value_of("  0.3 ", "m"), 0.3);
  EXPECT_EQ(value_of("0.1", "m"), 0.1);
  EXPECT_EQ(value_of("3.98600436e14", "m3/s2"), 3.98600436e14);
}

TEST(Numbers, HaveNoNegativeZero) {
  for (const char* text : {"-0", "-0.0", "-0 km", "-0e5 deg"}) {
    const Quantity quantity =
        parse_quantity(text, std::string_view(text).ends_with("deg") ? "rad" : "m");
    EXPECT_EQ(quantity.error, "") << text;
    EXPECT_FALSE(std::signbit(quantity.value)) << text;
  }
}

TEST(Numbers, RefuseOtherNotations) {
  for (const char* text :
       {"010",   "-010", "00",  "0x10", "0o17", "0b11",  "1_000", "1,5", "12:30",
        "1.2.3", "1-2",  "--1", "+-1",  "1e",   "1e+",   "e5",    ".",   "-",
        "+",     "",     " ",   "yes",  "true", "\"5\"", "5 5",   "5 %", "\xD9\xA5"}) {
    error_of(text, "m");
  }
  EXPECT_THAT(error_of("010", "m"), HasSubstr("leading zero"));
  EXPECT_THAT(parse_quantity("1,5", "m").hint, HasSubstr("point"));
  EXPECT_THAT(parse_quantity("12:30", "s").hint, HasSubstr("min"));
}

TEST(Numbers, AreRefusedHalfWritten) {
  for (const char* text : {"1e", "1E", "2.5e-", "1e+", "1e kg", "1e- kg"})
    EXPECT_THAT(error_of(text, "kg"), HasSubstr("incomplete number")) << text;
  for (const char* text : {"1d3", "1.5D-3", "1d+0", "2d1 kg"})
    EXPECT_THAT(error_of(text, "kg"), HasSubstr("the exponent begins with `e`")) << text;
  EXPECT_EQ(value_of("1d", "s"), 86400.0);  // a day is a unit
  EXPECT_EQ(value_of("1e3 kg", "kg"), 1000.0);
  EXPECT_THAT(parse_quantity("pi/2", "rad").hint, HasSubstr("`90 deg`"));
}

TEST(Numbers, AreFinite) {
  for (const char* text : {".nan", ".NaN", "nan", "NaN", ".inf", "-.inf", "+.INF", "inf", "-inf",
                           "infinity", "nan kg", "inf kg"}) {
    EXPECT_THAT(error_of(text, "kg"), HasSubstr("not finite")) << text;
  }
}

TEST(Numbers, RefuseWhatADoubleCannotHold) {
  for (const char* text : {"1e400", "-1e400", "1e-400", "1e-310", "1e99999999999999999999",
                           "1e-99999999999999999999", "1e308 km", "1e-307 um", "1e308 deg"}) {
    EXPECT_THAT(error_of(text, text == std::string_view("1e308 deg") ? "mas" : "m"),
                HasSubstr("outside the range"))
        << text;
  }
  EXPECT_EQ(value_of("1e306 mm", "m"), 1e303);
  EXPECT_EQ(value_of("1e309 mm", "m"), 1e306) << "only the result must fit";
  EXPECT_EQ(value_of("0e999999999999", "m"), 0.0);
}

TEST(Conversion, RoundsDecimalMultiplesOnce) {
  EXPECT_EQ(value_of("7000 km", "m"), 7.0e6);
  EXPECT_EQ(value_of("1 um", "m"), 1e-6);
  EXPECT_EQ(value_of("1 nm", "m"), 1e-9);
  EXPECT_EQ(value_of("20 mm", "m"), 0.02);
  EXPECT_EQ(value_of("100 ms", "s"), 0.1);
  EXPECT_EQ(value_of("0.3 mm", "m"), 0.0003);
  EXPECT_EQ(value_of("10 mN m", "N m"), 0.01);
  EXPECT_EQ(value_of("398600.4418 km3/s2", "m3/s2"), 398600.4418e9);
  EXPECT_EQ(value_of("5 um^2", "m2"), 5e-12);
  EXPECT_EQ(value_of("1.1 g", "kg"), 0.0011);
  EXPECT_EQ(value_of("1.004 g/cm3", "kg/m3"), 1004.0);
  EXPECT_EQ(value_of("7e-3 km", "m"), 7.0);
}

// UDUNITS has these to seven digits.
TEST(Conversion, IsExactForUnitsThatArePoundsBySomeFactor) {
  EXPECT_DOUBLE_EQ(value_of("1 slug", "kg"), 0.45359237 * 9.80665 / 0.3048);
  EXPECT_DOUBLE_EQ(value_of("1 slugs ft/s2", "N"), value_of("1 lbf", "N"));
  EXPECT_DOUBLE_EQ(value_of("2 slug ft2", "kg m2"), value_of("2 lbf ft s2", "kg m2"));
  EXPECT_DOUBLE_EQ(value_of("1 avoirdupois_ounce", "kg"), 0.028349523125);
  EXPECT_DOUBLE_EQ(value_of("1 short_hundredweight", "kg"), 45.359237);
}

TEST(Conversion, IsWithinOneUlpForOtherUnits) {
  const auto one_ulp = [](double x) { return std::nextafter(x, 2.0 * x) - x; };
  const double angle = 12.0 * (pi / 180.0);
  EXPECT_NEAR(value_of("12 deg", "rad"), angle, one_ulp(angle));
  const double rate = 6000.0 * (pi / 30.0);
  EXPECT_NEAR(value_of("6000 rpm", "rad/s"), rate, one_ulp(rate));
  EXPECT_EQ(value_of("15 min", "s"), 900.0);
  EXPECT_EQ(value_of("1 h", "s"), 3600.0);
  EXPECT_EQ(value_of("2 days", "s"), 172800.0);
  EXPECT_EQ(value_of("1 ft", "m"), 0.3048);
}

TEST(Units, AreThoseThatSpacecraftSpecsUse) {
  const struct {
    const char* text;
    const char* si;
    double value;
  } cases[] = {
      {"0.08 kg m2", "kg m2", 0.08},
      {"0.08 kg*m^2", "kg m2", 0.08},
      {"0.08 kg.m2", "kg m2", 0.08},
      {"0.08 kg-m2", "kg m2", 0.08},
      {"0.08 kg m**2", "kg m2", 0.08},
      {"0.08 kg m\u00B2", "kg m2", 0.08},
      {"0.08 kg\u00B7m\u00B2", "kg m2", 0.08},
      {"150 N m/rad", "N m/rad", 150.0},
      {"150 (N m)/rad", "N m/rad", 150.0},
      {"8 N m s/rad", "N m s/rad", 8.0},
      {"8 Nms/rad", "N m s/rad", 8.0},
      {"10.939 N/m", "N/m", 10.939},
      {"1.7285 N s/m", "N s/m", 1.7285},
      {"3.98600436e14 m3/s2", "m3/s2", 3.98600436e14},
      {"12 N m s", "N m s", 12.0},
      {"12 Nms", "N m s", 12.0},
      {"5 Nm", "N m", 5.0},
      {"5 mNm", "N m", 0.005},
      {"5 N-m", "N m", 5.0},
      {"445 N", "N", 445.0},
      {"5 \u00B5m", "m", 5e-6},
      {"5 \u03BCm", "m", 5e-6},
      {"5 hr", "s", 18000.0},
      {"5 mins", "s", 300.0},
      {"5 sec", "s", 5.0},
      {"5kg", "kg", 5.0},
      {"180\u00B0", "rad", pi},
      {"180 degrees", "rad", pi},
      {"0.5 rev/s", "rad/s", pi},
      {"30 RPM", "rad/s", pi},
      {"180 deg/s", "rad/s", pi},
      {"5 m s-2", "m/s2", 5.0},
      {"5 m/s^2", "m/s2", 5.0},
      {"1 AU", "m", 149597870700.0},
      {"5 percent", "1", 0.05},
  };
  for (const auto& c : cases) EXPECT_DOUBLE_EQ(value_of(c.text, c.si), c.value) << c.text;
}

TEST(Units, OfAnotherDimensionAreRefusedNamingBoth) {
  EXPECT_EQ(error_of("5 s", "kg"), "`5 s` is a time, a mass [kg] is expected");
  EXPECT_EQ(error_of("12 deg", "1"), "`12 deg` is an angle, a pure number is expected");
  EXPECT_THAT(error_of("12 kg", "rad"), AllOf(HasSubstr("a mass"), HasSubstr("an angle [rad]")));
  EXPECT_THAT(error_of("5 A m2", "kg"), AllOf(HasSubstr("A m2"), HasSubstr("a mass [kg]")));
}

TEST(Units, AreNotConvertedToTheirReciprocals) {
  error_of("0.5 Hz", "s");
  error_of("1 m3/kg", "kg/m3");
  error_of("1 s/m", "m/s");
}

TEST(Units, TellAnglesFromNumbers) {
  error_of("1 rad", "1");
  error_of("1 percent", "rad");
  error_of("1 N m/rad", "N m");
  error_of("1 N m rad", "N m/rad");
  EXPECT_THAT(error_of("50 Hz", "rad/s"), HasSubstr("frequency"));
  EXPECT_THAT(parse_quantity("50 Hz", "rad/s").hint, HasSubstr("rpm"));
  EXPECT_EQ(value_of("0.3", "1"), 0.3);
  EXPECT_EQ(value_of("0.3", "rad"), 0.3);
}

TEST(Units, MayLeaveAwayPerRadian) {
  EXPECT_EQ(value_of("1 N m", "N m/rad"), 1.0);
  EXPECT_EQ(value_of("1 N m s", "N m s/rad"), 1.0);
  EXPECT_DOUBLE_EQ(value_of("1 N m/deg", "N m/rad"), 180.0 / pi);
}

TEST(Units, RefuseWhatUdunitsReadsBeyondUnits) {
  for (const char* text :
       {"12 12 degree",  "kg @ 10",      "5 kg @ 10", "5 kg from 10", "5 seconds since 2000-01-01",
        "5 lg(re 1 kg)", "5 lg (re kg)", "5 dBm",     "5 degC",       "5 m2-1",
        "5 m.-2",        "5 2 m",        "5 m 2",     "5 10m",        "5 m/10",
        "5 m0",          "5 m^",         "5 m^2.5",   "5 m//s",       "5 /s",
        "5 (N m",        "5 N m)",       "5 '",       "5 \"",         "5 m;s",
        "5 UTC",         "5 m\xFF",      "5 m\n2"}) {
    for (const char* si : {"rad", "kg", "s", "m", "m2", "K"}) error_of(text, si);
  }
}

TEST(Units, ThatDoNotExistComeWithTheNearest) {
  EXPECT_EQ(error_of("5 KG", "kg"), "unknown unit `KG`");
  EXPECT_EQ(parse_quantity("5 KG", "kg").hint, "did you mean `kg`?");
  EXPECT_EQ(parse_quantity("5 dge", "rad").hint, "did you mean `deg`?");
  EXPECT_EQ(error_of("5 kg blub/s", "kg"), "unknown unit `blub`");
}

TEST(Units, WhoseBlanksAreMissingAreTakenApart) {
  const auto hint = [](const char* unit) {
    return parse_quantity(std::string("1 ") + unit, "s").hint;
  };
  EXPECT_EQ(hint("kgm2"), "did you mean `kg m2`?");
  EXPECT_EQ(hint("kgmm2"), "did you mean `kg mm2`?");
  EXPECT_EQ(hint("kgm^2/s"), "did you mean `kg m^2/s`?");
  EXPECT_EQ(hint("dps"), "did you mean `deg/s`?");
  EXPECT_EQ(hint("kmh"), "did you mean `km/h`?");
}

/// As many ways to read it as there are ways to cut it: a search of them all would not end.
TEST(Units, OfManyLettersAreRefusedAtOnce) {
  const std::string unit = std::string(40, 'm') + "ecombine";
  EXPECT_THAT(parse_quantity("1" + unit, "m").error, HasSubstr("unknown unit"));
  EXPECT_EQ(parse_quantity("1 kgmsrad", "m").hint, "did you mean `kg m s rad`?");
}

TEST(Quantity, KnowsWhichUnitItWasWrittenIn) {
  EXPECT_EQ(parse_quantity("5", "m").unit, "");
  EXPECT_EQ(parse_quantity("5 mm", "m").unit, "mm");
  EXPECT_EQ(parse_quantity("5 mm", "m").factor, 1e-3);
  EXPECT_EQ(parse_quantity("5 m", "m").factor, 1.0);
}

TEST(Units, WithoutANumberAreRefused) {
  EXPECT_EQ(error_of("kg", "kg"), "`kg` is a unit without its number");
  EXPECT_THAT(parse_quantity("N m/rad", "N m/rad").hint, HasSubstr("`1 N m/rad`"));
}

TEST(Units, OfAnyLengthAreAnsweredQuickly) {
  const std::string deep = "5 " + std::string(1'000'000, '(');
  EXPECT_LT(error_of(deep, "m").size(), 200u);
  EXPECT_LT(error_of("5 " + std::string(1'000'000, 'm'), "m").size(), 200u);
  EXPECT_LT(error_of(std::string(1'000'000, '9'), "m").size(), 200u);
}

TEST(ParseNumber, TakesNoUnit) {
  EXPECT_EQ(parse_number("0.25").value, 0.25);
  EXPECT_THAT(parse_number("1.0 kg").error, HasSubstr("has a unit"));
  EXPECT_NE(parse_number("1_000").error, "");
  EXPECT_NE(parse_number("many").error, "");
}

TEST(UnitFactor, ConvertsToTheFieldUnit) {
  EXPECT_EQ(unit_factor("mm", "m").value, 0.001);
  EXPECT_EQ(unit_factor("km", "m").value, 1000.0);
  EXPECT_DOUBLE_EQ(unit_factor(" deg ", "rad").value, pi / 180.0);
  EXPECT_THAT(unit_factor("kg", "m").error, AllOf(HasSubstr("a mass"), HasSubstr("a length")));
  EXPECT_NE(unit_factor("5 mm", "m").error, "");
  EXPECT_NE(unit_factor("", "m").error, "");
}

TEST(UnitSystem, ThrowsForAFieldUnitThatIsNone) {
  EXPECT_THROW(parse_quantity("5 m", "nonsense"), std::logic_error);
}

TEST(UnitSystem, ServesSeveralThreads) {
  std::vector<std::thread> threads;
  std::vector<double> sums(4);
  for (double& sum : sums) {
    threads.emplace_back([&sum] {
      for (int i = 0; i < 2000; ++i) {
        sum += parse_quantity(i % 2 == 0 ? "1 km" : "1 mN m s2/kg", i % 2 == 0 ? "m" : "m2").value;
        sum += parse_quantity("1 unknown", "m").value;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const double sum : sums) EXPECT_NEAR(sum, 1000.0 * 1000.001, 1e-6);
}

TEST(UnitSystem, PrintsNothingOfItsOwn) {
  testing::internal::CaptureStderr();
  error_of("5 nonsense", "m");
  error_of("5 kg @", "m");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(UnitDatabase, IsBesideItsBinaryOrOneFolderAbove) {
  const std::filesystem::path root =
      std::filesystem::path(testing::TempDir()) / fmt::format("unit-database-{}", ::getpid());
  const std::filesystem::path file = root / "udunits" / "udunits2.xml";
  EXPECT_EQ(unit_database_beside(root / "library.so"), "");
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << "<unit-system/>\n";
  EXPECT_EQ(unit_database_beside(root / "library.so"), file);
  EXPECT_EQ(unit_database_beside(root / "bin" / "program"), file);
  EXPECT_EQ(unit_database_beside(root / "bin" / "deeper" / "program"), "");
  std::filesystem::remove_all(root);
}

TEST(UnitDatabase, IsTheUsersWhereTheEnvironmentNamesOne) {
  ::setenv("UDUNITS2_XML_PATH", "/nowhere/units.xml", 1);
  EXPECT_EQ(own_unit_database(), "");
  ::unsetenv("UDUNITS2_XML_PATH");
}

TEST(UnitSystemDeathTest, SaysThatItsDatabaseCannotBeRead) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(
      {
        ::setenv("UDUNITS2_XML_PATH", "/nowhere/units.xml", 1);
        try {
          parse_quantity("5 m", "m");
        } catch (const std::runtime_error& fault) {
          std::fputs(fault.what(), stderr);
          ::_exit(7);
        }
      },
      testing::ExitedWithCode(7), "unit database");
}

}  // namespace
}  // namespace twincraft
