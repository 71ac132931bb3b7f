// What follows from judged figures, written by hand.
#include "runtime/compare/verdict.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace twincraft {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

JudgedFigure figure(double maximum, double tolerance) {
  return {JudgedFigure::Of::kConservation, "energy_relative", "bsm", "", maximum, tolerance};
}

TEST(Verdict, HoldsAtTheToleranceAndNeverWithANaN) {
  EXPECT_TRUE(figure(1.0, 1.0).held());
  EXPECT_TRUE(figure(0.0, 0.0).held());
  EXPECT_FALSE(figure(1.0 + 1.0e-15, 1.0).held());
  EXPECT_FALSE(figure(kNaN, 1.0).held());
}

TEST(Verdict, AgreesWhenEveryFigureOfAWholeRunHolds) {
  std::vector<JudgedFigure> figures{figure(0.5, 1.0), figure(0.1, 0.2)};
  EXPECT_EQ(judge(figures, true), Verdict::kAgree);
  EXPECT_EQ(judge(figures, false), Verdict::kNotJudged);
  figures.push_back(figure(2.0, 1.0));
  EXPECT_EQ(judge(figures, true), Verdict::kDisagree);
  EXPECT_EQ(judge(figures, false), Verdict::kDisagree) << "half a run can disagree";
}

TEST(Verdict, IsNotJudgedWithoutTolerances) { EXPECT_EQ(judge({}, true), Verdict::kNotJudged); }

}  // namespace
}  // namespace twincraft
