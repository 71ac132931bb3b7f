// The C interface where the facade does not reach: handles of what failed, nothing, wrong sizes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/api/vehicles.h"

namespace twincraft {
namespace {

using testing::HasSubstr;

TEST(CInterface, KnowsItsVersion) {
  EXPECT_EQ(tc_abi_version(), TC_ABI_VERSION);
  EXPECT_STREQ(tc_version(), TWINCRAFT_VERSION);
}

TEST(CInterface, GivesAHandleThatSaysWhatFailed) {
  tc_model* model = nullptr;
  EXPECT_EQ(tc_model_load("no/such.yaml", nullptr, &model), TC_FILE);
  ASSERT_NE(model, nullptr);
  EXPECT_THAT(tc_model_error(model), HasSubstr("no/such.yaml"));
  EXPECT_EQ(tc_model_count(model, TC_INPUTS), 0u);
  EXPECT_STREQ(tc_model_text(model, TC_NAME, nullptr), "");
  tc_simulation* simulation = nullptr;
  EXPECT_EQ(tc_simulation_new(model, TC_BSM, &simulation), TC_USAGE);
  EXPECT_EQ(simulation, nullptr);
  tc_model_free(model);
}

TEST(CInterface, TakesNothingForAHandle) {
  tc_model_free(nullptr);
  tc_simulation_free(nullptr);
  tc_twin_free(nullptr);
  tc_batch_free(nullptr);
  tc_run_free(nullptr);
  EXPECT_EQ(tc_simulation_step(nullptr, 1), TC_USAGE);
  EXPECT_EQ(tc_twin_step(nullptr, 1), TC_USAGE);
  EXPECT_EQ(tc_batch_step(nullptr, 1), TC_USAGE);
  EXPECT_EQ(tc_model_load(nullptr, nullptr, nullptr), TC_USAGE);
  EXPECT_TRUE(std::isnan(tc_simulation_time(nullptr)));
}

TEST(CInterface, ChecksSizes) {
  Simulation sim(test::quickstart());
  std::vector<double> numbers(3);
  EXPECT_EQ(tc_simulation_state(sim.handle(), numbers.data(), 3), TC_USAGE);
  EXPECT_STREQ(tc_simulation_error(sim.handle()), "20 numbers of a state, not 3");
  EXPECT_EQ(tc_simulation_drive(sim.handle(), 3, 1.0), TC_USAGE);
  EXPECT_EQ(tc_simulation_step(sim.handle(), 0), TC_USAGE);
  EXPECT_EQ(tc_simulation_step(sim.handle(), 1), TC_OK);
  EXPECT_STREQ(tc_simulation_error(sim.handle()), "a number of steps must be > 0");  // the last
}

TEST(CInterface, DrivesWhatAControllerNames) {
  Simulation sim(test::quickstart());
  const std::size_t driven[] = {0, 2};
  tc_control control{};
  control.size = sizeof control;
  control.every = 0.1;
  control.driven = driven;
  control.driven_count = 2;
  control.controller = [](void*, double, const double* outputs, double* inputs) {
    for (int i = 0; i < 3; ++i) inputs[i] = 1e-3 + outputs[10];
    return 0;
  };
  double reached = 0.0;
  ASSERT_EQ(tc_simulation_run_until(sim.handle(), 1.0, &control, &reached), TC_OK);
  EXPECT_EQ(reached, 1.0);
  EXPECT_EQ(tc_simulation_is_driven(sim.handle(), 0), 1);
  EXPECT_EQ(tc_simulation_is_driven(sim.handle(), 1), 0);
  EXPECT_EQ(tc_simulation_is_driven(sim.handle(), 2), 1);
  control.controller = [](void*, double, const double*, double* inputs) {
    inputs[0] = std::nan("");
    return 0;
  };
  const double held = sim.inputs().at(0);
  EXPECT_EQ(tc_simulation_run_until(sim.handle(), 2.0, &control, &reached), TC_USAGE);
  EXPECT_EQ(reached, 1.0);
  EXPECT_EQ(sim.inputs().at(0), held);
  control.every = -1.0;
  EXPECT_EQ(tc_simulation_run_until(sim.handle(), 2.0, &control, &reached), TC_USAGE);
  const std::size_t none = 17;
  control.every = 0.1;
  control.driven = &none;
  control.driven_count = 1;
  EXPECT_EQ(tc_simulation_run_until(sim.handle(), 2.0, &control, &reached), TC_USAGE);
  EXPECT_EQ(sim.time(), 1.0);
}

TEST(CInterface, SaysHowLargeASnapshotIs) {
  Simulation sim(test::quickstart());
  std::size_t size = 0;
  ASSERT_EQ(tc_simulation_snapshot(sim.handle(), nullptr, 0, &size), TC_OK);
  std::vector<unsigned char> bytes(size - 1, 7);
  ASSERT_EQ(tc_simulation_snapshot(sim.handle(), bytes.data(), bytes.size(), &size), TC_OK);
  EXPECT_EQ(size, bytes.size() + 1);
  EXPECT_EQ(bytes.front(), 7);  // there was no room, so nothing was written
}

}  // namespace
}  // namespace twincraft
