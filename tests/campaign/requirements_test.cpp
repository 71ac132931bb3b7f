// Requirements and early stops, and the words for them.
#include "runtime/campaign/requirements.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/runtime/handmade.h"

namespace twincraft {
namespace {

OutputColumn peak() {
  return {.name = "peak", .unit = "rad", .meaning = {}, .below = 5.0, .above = {}};
}

std::string broken(const OutputColumn& output, std::optional<double> value) {
  const std::string text = broken_requirements({&output, 1}, {&value, 1});
  EXPECT_EQ(text.empty(), holds(output, value)) << text;
  return text;
}

TEST(Requirements, SayWhatIsBroken) {
  EXPECT_EQ(broken(peak(), 4.9), "");
  EXPECT_EQ(broken(peak(), 5.2), "peak 5.2 rad is not below 5 rad");
  OutputColumn floor = peak();
  floor.below = 10.0;
  floor.above = 5.0;
  EXPECT_EQ(broken(floor, 7.0), "");
  EXPECT_EQ(broken(floor, -1.0 / 3.0), "peak -0.333333 rad is not above 5 rad");
}

TEST(Requirements, DoNotHoldOnTheBound) {
  EXPECT_EQ(broken(peak(), 5.0), "peak 5 rad is not below 5 rad");
  EXPECT_EQ(broken(peak(), std::nextafter(5.0, 0.0)), "");
}

TEST(Requirements, AreBrokenInAsManyDigitsAsItTakes) {
  EXPECT_EQ(broken(peak(), 5.0 + 1e-9), "peak 5.000000001 rad is not below 5 rad");
}

TEST(Requirements, NameNoUnitWhereThereIsNone) {
  OutputColumn ratio = peak();
  ratio.unit = "1";
  EXPECT_EQ(broken(ratio, 6.0), "peak 6 is not below 5");
}

TEST(Requirements, CountWhatWasNeverReachedAsInfinitelyLate) {
  EXPECT_EQ(broken(peak(), std::nullopt), "peak was never reached, so is not below 5 rad");
  OutputColumn late = peak();
  late.below.reset();
  late.above = 3.0;
  EXPECT_EQ(broken(late, std::nullopt), "");
}

TEST(Requirements, AreNotHeldByWhatIsNoNumber) {
  EXPECT_EQ(broken(peak(), std::nan("")), "peak nan rad is not below 5 rad");
}

TEST(Requirements, AreAllNamed) {
  OutputColumn other = peak();
  other.name = "end";
  OutputColumn free = peak();
  free.below.reset();
  const std::vector<OutputColumn> outputs = {peak(), free, other};
  const std::vector<std::optional<double>> values = {6.0, 7.0, 8.0};
  EXPECT_EQ(broken_requirements(outputs, values),
            "peak 6 rad is not below 5 rad; end 8 rad is not below 5 rad");
}

TEST(Requirements, SayWhatAColumnMeans) {
  OutputPlan plan;
  plan.name = "peak";
  plan.signal = "omega_BN_B";
  plan.reduce = Reduce::kMaxNorm;
  plan.unit = "rad/s";
  plan.below = 5.0;
  const OutputColumn column = column_of(plan);
  EXPECT_EQ(column.meaning, "largest norm of omega_BN_B");
  EXPECT_EQ(column.unit, "rad/s");
  EXPECT_TRUE(column.is_required());
}

TEST(StopWatch, StopsAMemberBeyondABound) {
  const Model model = test::model_of_every_kind();
  const std::vector<StopPlan> stops = {{"omega_BN_B", {}, 1.0}, {"mass", 50.0, {}}};
  const StopWatch watch(model, stops);
  Observation sample = test::sample_at(12.5, model);
  EXPECT_EQ(watch.reason(sample), "");
  sample.omega_BN_B = Vector3d(0.6, 0.8, 0.0);  // on the bound
  EXPECT_EQ(watch.reason(sample), "");
  sample.omega_BN_B = Vector3d(0.0, -1.2, 0.0);
  EXPECT_EQ(watch.reason(sample), "stopped at 12.5 s: omega_BN_B 1.2 rad/s is above 1 rad/s");
  sample.omega_BN_B.setZero();
  sample.mass = 49.0;
  EXPECT_EQ(watch.reason(sample), "stopped at 12.5 s: mass 49 kg is below 50 kg");
}

TEST(StopWatch, RefusesASignalThatTheModelDoesNotHave) {
  const std::vector<StopPlan> stops = {{"wing", {}, 1.0}};
  EXPECT_THROW(StopWatch(test::model_of_every_kind(), stops), std::invalid_argument);
}

}  // namespace
}  // namespace twincraft
