// Batches by the facade: every member flies as it would alone, on any number of threads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/api/vehicles.h"

namespace twincraft {
namespace {

using Rows = std::vector<double>;

Rows row(const Rows& rows, std::size_t i, std::size_t width) {
  return {rows.begin() + static_cast<std::ptrdiff_t>(i * width),
          rows.begin() + static_cast<std::ptrdiff_t>((i + 1) * width)};
}

/// States around the start, another for each member.
Rows dispersed(const Model& model, std::size_t count) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const Rows start = Simulation(model).state();
  Rows rows;
  for (std::size_t i = 0; i < count; ++i)
    for (const double x : start) rows.push_back(x + 1e-3 * normal(random));
  return rows;
}

Rows inputs_of(const Model& model, std::size_t count) {
  Rows rows;
  for (std::size_t i = 0; i < count * model.count(TC_INPUTS); ++i)
    rows.push_back(0.01 * std::sin(static_cast<double>(i)));
  return rows;
}

class Batches : public testing::TestWithParam<const char*> {
 protected:
  Model model() const { return Model::load(test::file(GetParam())); }
};

TEST_P(Batches, FlyEveryMemberAsItWouldAlone) {
  const Model model = this->model();
  constexpr std::size_t kCount = 11;  // no multiple of any number of lanes
  const Rows starts = dispersed(model, kCount), inputs = inputs_of(model, kCount);
  Batch batch(model, kCount, 2);
  batch.set_states(starts.data(), starts.size());
  batch.step(20);
  batch.drive(inputs.data(), inputs.size());
  batch.step(30);
  const Rows ends = batch.states(), outputs = batch.outputs();
  const std::size_t states = model.count(TC_STATES), width = model.count(TC_INPUTS);
  for (std::size_t i = 0; i < kCount; ++i) {
    Simulation alone(model);
    alone.set_state(row(starts, i, states));
    alone.step(20);
    alone.drive(0, inputs.data() + i * width, width);
    alone.step(30);
    const Rows end = alone.state(), seen = alone.observe();
    for (std::size_t k = 0; k < states; ++k)
      EXPECT_NEAR(ends.at(i * states + k), end.at(k), 1e-12 * (1.0 + std::abs(end.at(k))));
    for (std::size_t k = 0; k < seen.size(); ++k)
      EXPECT_NEAR(outputs.at(i * seen.size() + k), seen.at(k),
                  1e-12 * (1.0 + std::abs(seen.at(k))));
  }
  EXPECT_EQ(batch.inputs(), inputs);
  EXPECT_EQ(batch.time(), Simulation(model).model().step() * 50.0);
}

TEST_P(Batches, HaveTheSameBytesOnAnyNumberOfThreads) {
  const Model model = this->model();
  constexpr std::size_t kCount = 37;
  const Rows starts = dispersed(model, kCount);
  std::vector<Rows> ends;
  for (const std::size_t threads : {1u, 2u, 5u, 64u}) {
    Batch batch(model, kCount, threads);
    batch.set_states(starts.data(), starts.size());
    batch.step(20);
    ends.push_back(batch.states());
  }
  for (const Rows& end : ends) EXPECT_EQ(end, ends.front());
}

INSTANTIATE_TEST_SUITE_P(Of, Batches,
                         testing::Values("models/quickstart.yaml",              // lanes
                                         "models/paper/flex_panels.yaml",       // chains
                                         "tests/components/vehicles/jet.yaml",  // tanks: alone
                                         "models/gallery/branched_arm.yaml"),
                         [](const auto& param_info) {
                           std::string name = param_info.param;
                           name = name.substr(name.rfind('/') + 1);
                           return name.substr(0, name.find('.'));
                         });

TEST(Batch, FollowsSchedulesUntilItIsDrivenAndAfterItIsReleased) {
  const Model model = test::quickstart();
  Batch batch(model, 3);
  Simulation alone(model);
  const Rows push(model.count(TC_INPUTS), 0.02);
  batch.step(100);
  batch.drive(push.data(), push.size());  // one row serves all
  batch.step(100);
  batch.release();
  batch.step(2000);
  alone.step(100);
  alone.drive(0, push.data(), push.size());
  alone.step(100);
  for (std::size_t i = 0; i < push.size(); ++i) alone.release(i);
  alone.step(2000);
  const Rows end = alone.state(), all = batch.states();
  for (std::size_t k = 0; k < end.size(); ++k)
    EXPECT_NEAR(all.at(2 * end.size() + k), end.at(k), 1e-12 * (1.0 + std::abs(end.at(k))));
}

TEST(Batch, LetsAMemberEndAlone) {
  const Model model = test::quickstart();
  Batch batch(model, 9);
  Rows starts = batch.states();
  const std::size_t width = model.count(TC_STATES);
  starts.at(4 * width + model.find(TC_STATES, "rw_x.rate").first) = 1e200;
  starts.at(4 * width + model.find(TC_STATES, "omega_BN_B.x").first) = 1e150;
  batch.set_states(starts.data(), starts.size());
  batch.step(50);
  const std::vector<std::int32_t> status = batch.status();
  for (std::size_t i = 0; i < status.size(); ++i)
    EXPECT_EQ(status.at(i), i == 4 ? TC_NUMERICAL : TC_OK) << i;
  EXPECT_THAT(batch.reason(4), testing::HasSubstr("not finite at t = "));
  EXPECT_EQ(batch.reason(3), "");
  const Rows ends = batch.states();
  for (std::size_t k = 0; k < width; ++k) EXPECT_TRUE(std::isnan(ends.at(4 * width + k)));
  Simulation alone(model);
  alone.step(50);
  EXPECT_NEAR(ends.at(5 * width + 12), alone.state().at(12), 1e-15);
  starts = row(alone.state(), 0, width);
  batch.set_states(starts.data(), width);  // flies again
  batch.step(1);
  EXPECT_EQ(batch.status().at(4), TC_OK);
}

/// Members with tanks are flown one by one; the first one's failure is nobody else's, and it flies
/// again from the batch's time.
TEST(Batch, GoesOnWithoutItsFirstMember) {
  const Model model = Model::load(test::file("tests/components/vehicles/jet.yaml"));
  Batch batch(model, 2);
  const Rows start = batch.states();
  Rows broken = start;
  broken.at(model.find(TC_STATES, "omega_BN_B.x").first) = 1e200;
  batch.set_states(broken.data(), broken.size());
  batch.step(10);
  EXPECT_EQ(batch.status(), (std::vector<std::int32_t>{TC_NUMERICAL, TC_OK}));
  EXPECT_EQ(batch.time(), 10.0 * model.step());
  batch.set_states(start.data(), start.size());
  batch.step(10);
  EXPECT_EQ(batch.status(), (std::vector<std::int32_t>{TC_OK, TC_OK}));
  const std::size_t width = model.count(TC_STATES);
  EXPECT_EQ(row(batch.states(), 0, width), row(batch.states(), 1, width));
}

TEST(Batch, RefusesRowsThatDoNotFitAndStaysAsItWas) {
  const Model model = test::quickstart();
  Batch batch(model, 4);
  const Rows before = batch.inputs(), states = batch.states();
  Rows rows(7, 0.0);
  EXPECT_THROW(batch.drive(rows.data(), rows.size()), UsageError);
  rows.assign(12, 0.0);
  rows.at(11) = std::nan("");
  EXPECT_THROW(batch.drive(rows.data(), rows.size()), UsageError);
  rows = states;
  rows.back() = INFINITY;
  EXPECT_THROW(batch.set_states(rows.data(), rows.size()), UsageError);
  EXPECT_THROW(batch.step(0), UsageError);
  EXPECT_EQ(batch.inputs(), before);
  EXPECT_EQ(batch.states(), states);
  EXPECT_THROW(Batch(model, 0), UsageError);
}

}  // namespace
}  // namespace twincraft
