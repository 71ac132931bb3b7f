// Claims about what the analytic engine reports of itself: the sums of a sweep over all elements in
// plain doubles, for every kind of vehicle, law of gravity and chart, with every instruction set.
#include <gtest/gtest.h>

#include "tests/support/any_vehicle.h"
#include "tests/support/plain_observation.h"

namespace twincraft {
namespace {

using test::span_of;

constexpr double kRounding = 1.0e-14;

void expect_same(const Vector3d& found, const Vector3d& plain, double size) {
  EXPECT_LE((found - plain).norm(), kRounding * size);
}
void expect_same(double found, double plain, double size) {
  EXPECT_NEAR(found, plain, kRounding * size);
}

void expect_same(const Observation& found, const test::SizedObservation& plain) {
  expect_same(found.mass, plain.mass, plain.mass);
  expect_same(found.r_CN_N, plain.r_CN_N, plain.r_BN_N.norm() + 1.0);
  expect_same(found.v_CN_N, plain.v_CN_N, plain.momentum_scale / plain.mass);
  expect_same(found.momentum, plain.momentum, plain.momentum_scale);
  expect_same(found.H_PntC_N, plain.H_PntC_N, plain.H_scale);
  expect_same(found.own_kinetic, plain.own_kinetic, plain.own_kinetic_size);
  expect_same(found.kinetic, plain.kinetic, plain.kinetic + plain.own_kinetic_size);
  expect_same(found.springs, plain.springs, plain.springs);
  expect_same(found.potential, plain.potential, std::abs(plain.potential) + plain.springs);
  expect_same(found.momentum_scale, plain.momentum_scale, plain.momentum_scale);
  expect_same(found.H_scale, plain.H_scale, plain.H_scale);
}

class Observer : public test::AnyVehicle {
 protected:
  static void expect_plain_sums(const Model& model) {
    at_random_states<test::PlainObservation>(
        model,
        [](Engine& engine, test::PlainObservation& plain, double time, const Eigen::VectorXd& x) {
          expect_same(engine.observe(time, span_of(x)), plain.observe(time, span_of(x)));
        });
  }
};

TEST_P(Observer, SumsUpAllElements) { expect_plain_sums(model_); }

/// All numbers of an observation.
std::vector<double> numbers_of(const Observation& seen) {
  std::vector<double> numbers{seen.time,        seen.mass,    seen.kinetic,        seen.potential,
                              seen.own_kinetic, seen.springs, seen.momentum_scale, seen.H_scale};
  for (const Vector3d* v : {&seen.r_BN_N, &seen.v_BN_N, &seen.omega_BN_B, &seen.r_CN_N,
                            &seen.v_CN_N, &seen.momentum, &seen.H_PntC_N})
    numbers.insert(numbers.end(), v->begin(), v->end());
  for (const std::vector<double>* all : {&seen.joint_position, &seen.joint_rate, &seen.wheel_rate})
    numbers.insert(numbers.end(), all->begin(), all->end());
  return numbers;
}

TEST_P(Observer, SaysOfAStateTheSameBytesWhateverIsObservedWithIt) {
  for (const bsm::InstructionSet set : bsm::instruction_sets()) {
    const auto engine = make_bsm_engine(model_, set);
    const std::vector<RandomState> states = random_states(model_, 7);
    for (std::size_t count = 1; count <= engine->summed_at_once(); ++count) {
      std::vector<Observation> together(count);
      for (std::size_t i = 0; i < count; ++i) {
        const Eigen::VectorXd x = pack(states[i], engine->layout());
        engine->hold(inputs_at(model_, states[i].time));  // gone when it is summed up
        engine->note(states[i].time, span_of(x), together[i]);
      }
      engine->sum_up_noted();
      for (std::size_t i = 0; i < count; ++i) {
        const Eigen::VectorXd x = pack(states[i], engine->layout());
        engine->hold(inputs_at(model_, states[i].time));
        EXPECT_EQ(numbers_of(together[i]), numbers_of(engine->observe(states[i].time, span_of(x))));
      }
    }
  }
}

TEST_P(Observer, SumsUpUnderEveryLawOfGravityAndInQuaternions) {
  under_every_law([](Model model) {
    model.engines.attitude = AttitudeChart::kQuaternion;
    expect_plain_sums(model);
  });
}

INSTANTIATE_TEST_SUITE_P(Of, Observer, test::kAnyVehicle, test::vehicle_name);

}  // namespace
}  // namespace twincraft
