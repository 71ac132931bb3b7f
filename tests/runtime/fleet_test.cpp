// Vehicles flown side by side: each as it would fly alone, whoever is beside it.
#include "runtime/simulate/fleet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/simulate/engines.h"
#include "runtime/simulate/propagate.h"
#include "tests/support/compiled.h"

namespace twincraft {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kQuickstart = "models/quickstart.yaml";

Bundle quickstart(std::vector<std::string> settings) {
  settings.insert(settings.begin(), {"simulation.duration=6.01 s", "simulation.record=0.5 s"});
  return test::compiled_file(kQuickstart, settings);
}

/// Of one structure, of others, and two that no lane serves.
std::vector<Bundle> mixed() {
  std::vector<Bundle> fleet;
  for (int i = 0; i < 11; ++i)
    fleet.push_back(quickstart({"hub.mass=" + std::to_string(500 + 20 * i) + " kg",
                                "panels.*.stiffness=" + std::to_string(100 + 7 * i) + " N m/rad",
                                "wheels.rw_x.speed=" + std::to_string(100 * i) + " rpm"}));
  fleet.push_back(quickstart({"hub.center_of_mass=[0.1, 0, 0]"}));
  fleet.push_back(quickstart({"panels.*.segments=3"}));
  fleet.push_back(quickstart({"simulation.integrator=rkf45"}));
  fleet.push_back(test::compiled_file("models/paper/variable_mass.yaml",
                                      {"simulation.duration=3 s", "simulation.step=0.01 s"}));
  return fleet;
}

struct Flown {
  std::vector<Observation> samples;
  FleetEnd end;
};

std::vector<Flown> fly(const std::vector<const Bundle*>& bundles) {
  std::vector<Flown> flown(bundles.size());
  std::vector<FleetMember> members;
  for (std::size_t i = 0; i < bundles.size(); ++i)
    members.push_back({bundles[i], [samples = &flown[i].samples](const Observation& sample) {
                         samples->push_back(sample);
                         return true;
                       }});
  const std::vector<FleetEnd> ends = fly_fleet(members);
  for (std::size_t i = 0; i < bundles.size(); ++i) flown[i].end = ends[i];
  return flown;
}

std::vector<const Bundle*> all_of(const std::vector<Bundle>& bundles) {
  std::vector<const Bundle*> all;
  for (const Bundle& bundle : bundles) all.push_back(&bundle);
  return all;
}

/// Every number that a sample shows.
std::vector<double> numbers_of(const Model& model, const Observation& sample) {
  std::vector<double> numbers{sample.time};
  for (const OutputSignal& output : outputs_of(model))
    for (std::size_t i = 0; i < output.size(); ++i) numbers.push_back(value_of(output, i, sample));
  return numbers;
}

TEST(Fleet, FliesEveryVehicleAsItWouldAlone) {
  const std::vector<Bundle> fleet = mixed();
  const std::vector<Flown> flown = fly(all_of(fleet));
  for (std::size_t k = 0; k < fleet.size(); ++k) {
    const Model& model = fleet[k].model;
    const Trajectory alone = propagate(*make_engine(EngineKind::kBsm, fleet[k]), model);
    ASSERT_EQ(flown[k].samples.size(), alone.samples.size()) << k;
    EXPECT_THAT(flown[k].end.failure, IsEmpty());
    EXPECT_EQ(flown[k].end.last.time, model.simulation.duration);
    for (std::size_t i = 0; i < alone.samples.size(); ++i) {
      const std::vector<double> ours = numbers_of(model, flown[k].samples[i]),
                                expected = numbers_of(model, alone.samples[i]);
      for (std::size_t n = 0; n < ours.size(); ++n)
        EXPECT_NEAR(ours[n], expected[n], 1e-12 * (1.0 + std::abs(expected[n]))) << k << ", " << n;
    }
  }
}

TEST(Fleet, FliesNoneOtherwiseForWhatTheOthersAre) {
  const std::vector<Bundle> fleet = mixed();
  std::vector<const Bundle*> backwards = all_of(fleet);
  std::ranges::reverse(backwards);
  const std::vector<Flown> together = fly(all_of(fleet)), turned = fly(backwards);
  for (std::size_t k = 0; k < fleet.size(); ++k) {
    const std::vector<Flown> alone = fly({&fleet[k]});
    for (std::size_t i = 0; i < together[k].samples.size(); ++i) {
      const std::vector<double> ours = numbers_of(fleet[k].model, together[k].samples[i]);
      EXPECT_EQ(ours, numbers_of(fleet[k].model, alone[0].samples.at(i))) << k;
      EXPECT_EQ(ours, numbers_of(fleet[k].model, turned[fleet.size() - 1 - k].samples.at(i))) << k;
    }
  }
}

TEST(Fleet, LetsOneStopOrFailAndTheOthersFlyOn) {
  // An explicit method cannot follow a spring as stiff as this.
  const std::vector<Bundle> fleet{quickstart({}),
                                  quickstart({"panels.wing_p.stiffness=1e9 N m/rad"}),
                                  quickstart({"hub.mass=700 kg"})};
  std::vector<std::size_t> samples(fleet.size());
  std::vector<FleetMember> members;
  for (std::size_t i = 0; i < fleet.size(); ++i)
    members.push_back({&fleet[i], [&samples, i](const Observation&) {
                         ++samples[i];
                         return i != 0 || samples[i] < 3;
                       }});
  const std::vector<FleetEnd> ends = fly_fleet(members);
  EXPECT_EQ(ends[0].last.time, 1.0);
  EXPECT_EQ(samples[0], 3U);
  EXPECT_THAT(ends[0].failure, IsEmpty());
  EXPECT_THAT(ends[1].failure, HasSubstr("at t = "));
  EXPECT_EQ(ends[2].last.time, 6.01);
  EXPECT_EQ(samples[2], 14U);
}

/// An explicit method follows a spring as stiff as this for a few samples and no further.
const std::vector<std::string> kFailsMidway{"panels.wing_p.stiffness=1.33e6 N m/rad",
                                            "simulation.record=0.1 s"};

std::vector<double> times_of(const std::vector<Observation>& samples) {
  std::vector<double> times;
  for (const Observation& sample : samples) times.push_back(sample.time);
  return times;
}

TEST(Fleet, TakesTheSamplesOfARecordedRunInTheirOrderAndOnce) {
  std::vector<Bundle> fleet = mixed();
  fleet.push_back(quickstart(kFailsMidway));
  fleet.push_back(quickstart({"simulation.integrator=rkf45", "simulation.record=0.7 s"}));
  const std::vector<Flown> flown = fly(all_of(fleet));
  for (std::size_t k = 0; k < fleet.size(); ++k) {
    const Trajectory alone = propagate(*make_engine(EngineKind::kBsm, fleet[k]), fleet[k].model);
    const std::vector<double> times = times_of(flown[k].samples);
    EXPECT_EQ(times, times_of(alone.samples)) << k;
    EXPECT_EQ(flown[k].end.last.time, times.back()) << k;
    EXPECT_EQ(flown[k].end.failure.empty(), alone.failure.empty()) << k;
  }
}

/// Flies one that need not fly on after `last` samples.
Flown fly_until(const Bundle& bundle, std::size_t last) {
  Flown flown;
  const FleetMember member{&bundle, [&](const Observation& sample) {
                             flown.samples.push_back(sample);
                             return flown.samples.size() < last;
                           }};
  flown.end = fly_fleet({&member, 1}).front();
  return flown;
}

TEST(Fleet, ForgetsWhatCameAfterTheSampleThatNeedNotFlyOn) {
  const Bundle fails = quickstart(kFailsMidway);
  const Flown whole = fly({&fails}).front();
  ASSERT_EQ(whole.samples.size(), 5U);  // of which one at least waited for others
  ASSERT_THAT(whole.end.failure, HasSubstr("at t = "));
  for (std::size_t last = 1; last <= whole.samples.size(); ++last) {
    const Flown stopped = fly_until(fails, last);
    EXPECT_EQ(stopped.samples.size(), last);
    EXPECT_EQ(stopped.end.last.time, whole.samples[last - 1].time);
    EXPECT_THAT(stopped.end.failure, IsEmpty()) << last;
    EXPECT_FALSE(stopped.end.is_interrupted);
  }
}

TEST(Fleet, KnowsTheErrorsOfAnAdaptiveMethodUpToTheLastSample) {
  const Bundle longer = quickstart({"simulation.integrator=rkf45"});
  for (const std::size_t last : {2U, 3U, 5U}) {
    const std::string end = std::to_string(0.5 * static_cast<double>(last - 1)) + " s";
    const Flown stopped = fly_until(longer, last);
    const Bundle shorter =
        quickstart({"simulation.integrator=rkf45", "simulation.duration=" + end});
    const Flown whole = fly({&shorter}).front();
    EXPECT_EQ(stopped.end.last.time, whole.end.last.time);
    EXPECT_GT(stopped.end.accepted.attitude, 0.0);
    EXPECT_EQ(stopped.end.accepted.attitude, whole.end.accepted.attitude);
    EXPECT_EQ(stopped.end.accepted.joint, whole.end.accepted.joint);
  }
}

TEST(Fleet, IsInterruptedByASignal) {
  const std::vector<Bundle> fleet{quickstart({}), quickstart({"simulation.integrator=rkf45"})};
  std::atomic<bool> stop = false;
  std::vector<FleetMember> members;
  for (const Bundle& bundle : fleet)
    members.push_back({&bundle, [&stop](const Observation& sample) {
                         stop = sample.time >= 2.0;
                         return true;
                       }});
  for (const FleetEnd& end : fly_fleet(members, {.stop = &stop})) EXPECT_TRUE(end.is_interrupted);
}

}  // namespace
}  // namespace twincraft
