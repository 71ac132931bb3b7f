// Stored states against the samples of a run: which are met, what is compared, what is judged.
#include "runtime/reference/stored.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "runtime/simulate/propagate.h"
#include "tests/runtime/toy_engine.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> metrics_of(const std::vector<Deviation>& deviations) {
  std::vector<std::string> metrics;
  for (const Deviation& deviation : deviations) metrics.push_back(deviation.metric);
  return metrics;
}

Observation sample_at(double time) {
  Observation sample;
  sample.time = time;
  sample.r_BN_N = {1.0, 0.0, 0.0};
  sample.r_CN_N = {2.0, 0.0, 0.0};
  sample.q_BN = Quaterniond::Identity();
  sample.omega_BN_B = Vector3d::Zero();
  return sample;
}

TEST(Stored, ComparesWhatAStateGivesAtItsOwnTime) {
  StoredTruth truth;
  truth.states.emplace_back().time = 10.0;
  truth.states[0].position = Vector3d(2.0, 0.0, 0.25);
  truth.states.emplace_back().time = 20.0;
  truth.states[1].q_BN = Quaterniond(Eigen::AngleAxisd(1.0e-9, Vector3d::UnitY()));
  truth.attitude = 2.0e-9;
  const std::vector<Observation> samples{sample_at(0.0), sample_at(10.0), sample_at(20.0)};
  const std::vector<Deviation> found = stored_deviations(truth, samples);
  ASSERT_THAT(metrics_of(found), ElementsAre("position_m", "attitude_deg"));
  EXPECT_EQ(found[0].max, 0.25);
  EXPECT_EQ(found[0].at, 10.0);
  EXPECT_EQ(found[0].pass(), std::nullopt);
  EXPECT_NEAR(found[1].max, 1.0e-9 * 180.0 / std::numbers::pi, 1.0e-16);
  EXPECT_EQ(found[1].at, 20.0);
  EXPECT_EQ(found[1].pass(), true);
  truth.attitude = 0.5e-9;
  EXPECT_EQ(stored_deviations(truth, samples)[1].pass(), false);
  truth.of_hub = true;
  EXPECT_GT(stored_deviations(truth, samples)[0].max, 1.0);
}

TEST(Stored, SaysNothingOfWhatTheRunDidNotReach) {
  StoredTruth truth;
  truth.states.emplace_back().time = 10.0;
  truth.states[0].omega_BN_B = Vector3d::Zero();
  const std::vector<Observation> samples{sample_at(0.0), sample_at(9.999)};
  EXPECT_THAT(stored_deviations(truth, samples), IsEmpty());
}

TEST(Stored, NeverPassesANotANumber) {
  StoredTruth truth;
  truth.rate = 1.0;
  truth.states.emplace_back().omega_BN_B = Vector3d::Zero();
  std::vector<Observation> samples{sample_at(0.0)};
  samples[0].omega_BN_B.x() = std::nan("");
  EXPECT_EQ(stored_deviations(truth, samples)[0].pass(), false);
}

TEST(Stored, IsMetBetweenStepsAndRecords) {
  Model model = toy_model();
  model.simulation.step = 1.0;
  model.simulation.duration = 10.0;
  model.simulation.record = 5.0;
  model.references = {ReferenceKind::kStored};
  for (const double time : {0.0, 0.7, 3.0, 10.0}) {
    model.stored.states.emplace_back().time = time;
    model.stored.states.back().omega_BN_B = model.initial.omega_BN_B;
  }
  ToyEngine engine(model);
  std::vector<double> times;
  for (const Observation& sample : propagate(engine, model).samples) times.push_back(sample.time);
  EXPECT_THAT(times, ElementsAre(0.0, 0.7, 3.0, 5.0, 10.0));
}

}  // namespace
}  // namespace twincraft
