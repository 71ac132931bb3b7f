// Claims about what the analytic engine reports of itself: the sums of a sweep over all elements in
// plain doubles, for every kind of vehicle, law of gravity and chart, with every instruction set.
#include <gtest/gtest.h>

#include "runtime/bsm/engine.h"
#include "runtime/compare/random_state.h"
#include "tests/support/compiled.h"
#include "tests/support/plain_observation.h"

namespace twincraft {
namespace {

std::span<const double> span_of(const Eigen::VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

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

class Observer : public testing::TestWithParam<const char*> {
 protected:
  static void expect_plain_sums(const Model& model) {
    test::PlainObservation plain(model);
    for (const bsm::InstructionSet set : bsm::instruction_sets()) {
      const auto engine = make_bsm_engine(model, set);
      for (const RandomState& state : random_states(model, 20)) {
        const Inputs inputs = inputs_at(model, state.time);
        const Eigen::VectorXd x = pack(state, engine->layout());
        engine->hold(inputs);
        plain.hold(inputs);
        expect_same(engine->observe(state.time, span_of(x)), plain.observe(state.time, span_of(x)));
      }
    }
  }

  const Model model_ =
      test::compiled_file("tests/components/vehicles/" + std::string(GetParam()) + ".yaml").model;
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
  for (const GravityLaw law : {GravityLaw::kNone, GravityLaw::kSystemCom, GravityLaw::kBodyCom,
                               GravityLaw::kBodyGradient}) {
    SCOPED_TRACE(testing::Message() << "law " << static_cast<int>(law));
    Model model = model_;
    model.gravity = {5.0e4, law, law};
    model.initial.r_BN_N = {60.0, -20.0, 30.0};  // where metres make a difference
    model.initial.v_BN_N = {-3.0, 20.0, 5.0};
    model.engines.attitude = AttitudeChart::kQuaternion;
    expect_plain_sums(model);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Observer,
                         testing::Values("hub", "wheel", "panel", "chain", "damped", "gravity",
                                         "arm", "arm_in_orbit", "flex_as_bodies", "particle",
                                         "pendulum", "bob", "burn", "jet"),
                         [](const auto& param_info) { return param_info.param; });

}  // namespace
}  // namespace twincraft
