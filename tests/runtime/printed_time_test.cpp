// Files of runs at different steps join on time.
#include "runtime/report/printed_time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "compiler/ir/number.h"

namespace twincraft {
namespace {

TEST(PrintedTime, IsTheShortDecimalThatAMultipleStandsFor) {
  const PrintedTime printed(0.1);
  ASSERT_NE(3 * 0.1, 0.3);  // or there would be nothing to do
  EXPECT_EQ(printed(3 * 0.1), 0.3);
  EXPECT_EQ(printed(0.1), 0.1);
  EXPECT_EQ(printed(0.0), 0.0);
  EXPECT_EQ(shortest(printed(10'000'003 * 0.1)), "1000000.3");
}

TEST(PrintedTime, HasNoMoreDigitsThanTheStepOverAMillionSteps) {
  // The multiple is rounded once, as the step was: half a unit each, and the label's own half.
  const double two_units = 2.0 * std::numeric_limits<double>::epsilon();
  for (const double step : {0.1, 0.02, 0.3, 0.007, 1.1, 2.5e-5, 1e-9, 0.123456789}) {
    const PrintedTime printed(step);
    for (int index = 1; index < 1'000'000; index += 7) {
      const double time = printed(index * step);
      ASSERT_LE(shortest(time).size(), 18u) << step << " " << index;
      ASSERT_LE(std::abs(time / (index * step) - 1.0), two_units) << step << " " << index;
    }
  }
}

TEST(PrintedTime, IsTheSameForRunsAtDifferentSteps) {
  const PrintedTime coarse(0.1), fine(0.02), finest(0.005);
  for (int index = 1; index <= 100'000; ++index) {
    const double time = coarse(index * 0.1);
    ASSERT_EQ(time, fine(5 * index * 0.02)) << index;
    ASSERT_EQ(time, finest(20 * index * 0.005)) << index;
  }
}

TEST(PrintedTime, LeavesAloneWhatIsNoMultipleOfAShortStep) {
  const double event = std::nextafter(0.3, 0.0);
  EXPECT_EQ(PrintedTime(0.1)(event), event);
  EXPECT_EQ(PrintedTime(0.1)(0.25), 0.25);
  const double third = 1.0 / 3.0;
  EXPECT_EQ(PrintedTime(third)(7 * third), 7 * third);
}

TEST(PrintedTime, HoldsForLongRunsAndLongSteps) {
  EXPECT_EQ(PrintedTime(100.0)(3'000'000 * 100.0), 3.0e8);
  EXPECT_EQ(PrintedTime(1e22)(3e22), 3e22);
  EXPECT_EQ(PrintedTime(1e-5)(2e9 * 1e-5),
            2e9 * 1e-5);  // beyond a thousand million steps: as it is
}

}  // namespace
}  // namespace twincraft
