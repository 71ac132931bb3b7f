// Claims about the rates of the books that the kernel finds: those of a sweep over all links in
// plain doubles, for every kind of vehicle, force and law of gravity, with every instruction set.
#include <gtest/gtest.h>

#include "runtime/bsm/engine.h"
#include "runtime/compare/random_state.h"
#include "tests/support/compiled.h"
#include "tests/support/plain_books.h"

namespace twincraft {
namespace {

std::span<const double> span_of(const Eigen::VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

constexpr double kRounding = 1.0e-13;

void expect_same(const BookRates& found, const test::SizedRates& plain) {
  EXPECT_NEAR(found.power, plain.power, kRounding * plain.power_size);
  EXPECT_NEAR(found.own_power, plain.own_power, kRounding * plain.own_power_size);
  EXPECT_LE((found.force_N - plain.force_N).norm(), kRounding * plain.force_size);
  EXPECT_LE((found.torque_PntC_N - plain.torque_PntC_N).norm(), kRounding * plain.torque_size);
}

/// So near a small body that links metres apart feel very different gravity.
void put_beside_an_asteroid(GravityLaw law, Model& model) {
  model.gravity = {5.0e4, law, law};
  model.initial.r_BN_N = {60.0, -20.0, 30.0};
  model.initial.v_BN_N = {-3.0, 20.0, 5.0};
}

/// On the hub, and on the last link where it can take one: at a point, and at the centre of mass.
void push(Model& model) {
  const int last = static_cast<int>(model.assembly.links.size()) - 1;
  for (const int link : {0, last}) {
    Load at_point{"push", link, {}, {}, Vector3d(0.1, 0.2, 0.3)};
    at_point.force_L[1] = Schedule::constant(3.0);
    at_point.torque_L[2] = Schedule::constant(-2.0);
    Load at_center{"pull", link, {}, {}, {}};
    at_center.force_L[0] = Schedule::constant(-4.0);
    model.loads.insert(model.loads.end(), {at_point, at_center});
  }
}

class Books : public testing::TestWithParam<const char*> {
 protected:
  void expect_plain_books(const Model& model) const {
    test::PlainBooks plain(model);
    for (const bsm::InstructionSet set : bsm::instruction_sets()) {
      const auto engine = make_bsm_engine(model, set);
      for (const RandomState& state : random_states(model, 20)) {
        const Inputs inputs = inputs_at(model, state.time);
        const Eigen::VectorXd x = pack(state, engine->layout());
        std::vector<double> rate(static_cast<std::size_t>(x.size()));
        BookRates books;
        engine->hold(inputs);
        plain.hold(inputs);
        engine->derivative(state.time, span_of(x), rate, &books);
        expect_same(books, plain.rates(state.time, span_of(x)));
      }
    }
  }

  const Model model_ =
      test::compiled_file("tests/components/vehicles/" + std::string(GetParam()) + ".yaml").model;
};

TEST_P(Books, AreThoseOfASweepOverAllLinks) { expect_plain_books(model_); }

TEST_P(Books, AreSoUnderEveryLawOfGravityAndUnderLoads) {
  for (const GravityLaw law : {GravityLaw::kNone, GravityLaw::kSystemCom, GravityLaw::kBodyCom,
                               GravityLaw::kBodyGradient}) {
    SCOPED_TRACE(testing::Message() << "law " << static_cast<int>(law));
    Model model = model_;
    put_beside_an_asteroid(law, model);
    expect_plain_books(model);
    push(model);
    expect_plain_books(model);
  }
}

TEST_P(Books, AreSoOnTheGeneralPathAndInQuaternions) {
  Model model = model_;
  model.engines.chains = ChainPath::kGeneral;
  model.engines.attitude = AttitudeChart::kQuaternion;
  put_beside_an_asteroid(GravityLaw::kBodyCom, model);
  expect_plain_books(model);
}

INSTANTIATE_TEST_SUITE_P(Of, Books,
                         testing::Values("hub", "wheel", "panel", "chain", "damped", "gravity",
                                         "arm", "arm_in_orbit", "flex_as_bodies", "particle",
                                         "pendulum", "bob", "burn", "jet"),
                         [](const auto& param_info) { return param_info.param; });

}  // namespace
}  // namespace twincraft
