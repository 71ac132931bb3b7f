// Both engines in lock step, by the facade.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/api/vehicles.h"

namespace twincraft {
namespace {

using Json = nlohmann::json;

TEST(Twins, StayTogetherUnderOneController) {
  Twin twin(test::burn());
  const Simulation lead = twin.simulation(Engine::bsm);
  twin.run_until(4.0, 0.1, [&](double) {
    const double thrust = 20.0 - 200.0 * lead.observe().at(12);
    twin.drive(lead.model().find(TC_INPUTS, "kicker.thrust").first, thrust);
  });
  EXPECT_EQ(twin.time(), 4.0);
  EXPECT_EQ(twin.simulation(Engine::bsm).inputs(), twin.simulation(Engine::mujoco).inputs());
  const Json all = Json::parse(twin.disagreement());
  EXPECT_LT(all.at("rate_rad_s").at("max"), 1e-14);
  EXPECT_LT(all.at("attitude_deg").at("max"), 1e-6);
  EXPECT_GT(all.at("attitude_deg").at("max"), 0.0);
  EXPECT_LE(all.at("attitude_deg").at("now"), all.at("attitude_deg").at("max"));
}

TEST(Twins, SayWhatTheReportOfTheRunSays) {
  const Model model = Model::load(test::file("models/quickstart.yaml"),
                                  {"simulation.record=0.02 s", "simulation.duration=4 s"});
  Twin twin(model);
  twin.run_until(4.0);
  const Json report = Json::parse(std::string(model.run().json()));
  const Json agreement = report.at("members").at(0).at("agreement");
  const Json ours = Json::parse(twin.disagreement());
  for (const auto& [key, figure] : ours.items()) {
    EXPECT_EQ(figure.at("max"), agreement.at(key).at("max")) << key;
    EXPECT_EQ(figure.at("tolerance"), agreement.at(key).at("tolerance")) << key;
    EXPECT_EQ(figure.at("pass"), agreement.at(key).at("pass")) << key;
  }
}

TEST(Twins, LetEachEngineHaveItsController) {
  Twin twin(test::ports());
  int calls[2] = {0, 0};
  tc_control bsm{}, mujoco{};
  const std::size_t wheel = 0;
  for (tc_control* control : {&bsm, &mujoco}) {
    control->size = sizeof *control;
    control->every = 0.1;
    control->driven = &wheel;
    control->driven_count = 1;
    control->controller = [](void* count, double, const double*, double* inputs) {
      inputs[0] = 0.01 * ++*static_cast<int*>(count);
      return 0;
    };
  }
  bsm.context = &calls[0];
  mujoco.context = &calls[1];
  calls[1] = 10;  // the other engine gets other torques
  double reached = 0.0;
  ASSERT_EQ(tc_twin_run_each_until(twin.handle(), 1.0, &bsm, &mujoco, &reached), TC_OK);
  EXPECT_EQ(reached, 1.0);
  EXPECT_EQ(calls[0], 10);
  EXPECT_EQ(twin.simulation(Engine::bsm).inputs().front(), 0.01 * 10);
  EXPECT_EQ(twin.simulation(Engine::mujoco).inputs().front(), 0.01 * 20);
  EXPECT_GT(Json::parse(twin.disagreement()).at("wheel_rate_rad_s").at("max"), 0.1);
}

TEST(Twins, GoOnFromASnapshotAndFromACopy) {
  Twin twin(test::burn());
  twin.run_until(3.3);
  Twin copy = twin;
  const std::vector<std::uint8_t> bytes = twin.snapshot();
  twin.step(20);
  copy.step(20);
  EXPECT_EQ(copy.disagreement(), twin.disagreement());
  const std::vector<double> end = twin.simulation(Engine::mujoco).state();
  twin.restore(bytes.data(), bytes.size());
  EXPECT_EQ(twin.time(), 3.3);
  twin.step(20);
  EXPECT_EQ(twin.simulation(Engine::mujoco).state(), end);
  EXPECT_THROW(twin.restore(bytes.data(), bytes.size() / 2), SnapshotError);
  twin.reset();
  EXPECT_EQ(twin.time(), 0.0);
}

TEST(Twins, MoveTheirEnginesThemselves) {
  Twin twin(test::quickstart());
  Simulation one = twin.simulation(Engine::bsm);
  EXPECT_THROW(one.step(), UsageError);
  EXPECT_THROW(one.run_until(1.0), UsageError);
  EXPECT_THROW(one.reset(), UsageError);
  EXPECT_EQ(one.time(), 0.0);
}

TEST(Twins, LastAsLongAsTheirEnginesAreAsked) {
  const Simulation one = Twin(test::quickstart()).simulation(Engine::mujoco);
  EXPECT_EQ(one.time(), 0.0);
}

/// Both stand at the same good step end.
TEST(Twins, FailTogether) {
  Twin twin(Model::load(test::file("models/quickstart.yaml"), {"simulation.step=5 s"}));
  EXPECT_THROW(twin.step(100'000), NumericalFailure);
  EXPECT_EQ(twin.simulation(Engine::bsm).time(), twin.simulation(Engine::mujoco).time());
}

}  // namespace
}  // namespace twincraft
