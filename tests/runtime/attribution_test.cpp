// Claims about shares, laws and remainders, on differences whose causes are known because they were
// put there.
#include "runtime/study/attribution.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/report/attribution_words.h"
#include "tests/runtime/handmade.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Grows with time along `direction`.
ErrorSeries ramp(const Vector3d& direction) {
  ErrorSeries series;
  for (double time : {0.0, 0.5, 1.0}) {
    series.time.push_back(time);
    series.value.emplace_back(time * direction);
  }
  return series;
}

TEST(Share, OfCausesThatAddUpAddsUpToOne) {
  const Vector3d a(3.0, 1.0, 0.0), b(-1.0, 2.0, 0.5);
  const ErrorSeries whole = ramp(a + b);
  EXPECT_NEAR(share(whole, ramp(b)) + share(whole, ramp(a)), 1.0, 1e-15);
  EXPECT_EQ(share(whole, ramp(Vector3d::Zero())), 1.0);
  EXPECT_EQ(share(whole, whole), 0.0);
}

TEST(Share, IsNegativeForWhatWorksAgainstTheOthers) {
  const ErrorSeries whole = ramp({1.0, 0.0, 0.0});  // 3 - 2
  EXPECT_EQ(share(whole, ramp({-2.0, 0.0, 0.0})), 3.0);
  EXPECT_EQ(share(whole, ramp({3.0, 0.0, 0.0})), -2.0);
  EXPECT_EQ(share(ramp(Vector3d::Zero()), whole), 0.0);  // there is nothing to share
}

TEST(ErrorSeries, HoldsTheRotationBetweenAttitudesInInertialComponents) {
  const Model model = test::model_of_every_kind();
  Trajectory a = test::standstill(model), b = a;
  const Vector3d axis = Vector3d(1.0, -2.0, 2.0) / 3.0;
  const Quaterniond start(Eigen::AngleAxisd(2.0, Vector3d(0.6, 0.0, 0.8)));
  a.samples[1].q_BN = start;
  b.samples[1].q_BN = Quaterniond(Eigen::AngleAxisd(1.0e-12, axis)) * start;
  b.samples[2].q_BN = Quaterniond(Eigen::AngleAxisd(-0.5, axis));
  const ErrorSeries error = attitude_error(a, b);
  ASSERT_EQ(error.time.size(), 3u);
  EXPECT_EQ(error.value[0], Vector3d::Zero());
  // The attitudes themselves are rounded: 1e-16 in 1e-12.
  EXPECT_LT((error.value[1] - 1.0e-12 * axis).norm(), 1.0e-15);
  EXPECT_LT((error.value[2] + 0.5 * axis).norm(), 1.0e-15);
  EXPECT_NEAR(error.maximum(), 0.5, 1e-15);
}

TEST(ErrorSeries, SubtractsOnlyWhatWasSampledAtOneInstant) {
  ErrorSeries twice_as_often = ramp({1.0, 0.0, 0.0});
  twice_as_often.time = {0.0, 0.25, 0.5 + 1.0e-15};
  const ErrorSeries rest = difference(ramp({2.0, 0.0, 0.0}), twice_as_often);
  EXPECT_THAT(rest.time, ElementsAre(0.0, 0.5));
  EXPECT_EQ(rest.value[1], Vector3d::Zero());  // 2 * 0.5 - 1
}

TEST(LogSlope, IsTheExponentOfAPower) {
  EXPECT_NEAR(log_slope({10.0, 1.0, 0.1}, {5.0e3, 5.0e-1, 5.0e-5}), 4.0, 1e-12);
}

/// Two wheels of a token mass, flown in MRPs; every cause puts in what `run` says.
class Attributing : public testing::Test {
 protected:
  Attributing() {
    Model& model = bundle.model;
    model = test::model_of_every_kind();
    model.simulation.record = 0.5;
    model.engines.bob_inertia = 1.0e-4;
  }

  static bool is_set(const Overrides& changes, const std::string& change) {
    return std::find(changes.begin(), changes.end(), change) != changes.end();
  }
  static double value_of(const Overrides& changes, const std::string& path, double otherwise) {
    for (const std::string& change : changes)
      if (change.starts_with(path + "=")) return std::stod(change.substr(path.size() + 1));
    return otherwise;
  }

  /// Bob: linear along x. Chart: fourth order in the step along y. Rest: along z.
  VariantResult fly(const Overrides& changes) const {
    const double bob = value_of(changes, "engines.mujoco.bob_inertia", 1.0e-4);
    const double step = value_of(changes, "simulation.step", 0.5);
    const bool mrp = !is_set(changes, "engines.bsm.attitude=quaternion");
    const double chart = mrp ? 1.0e-6 * std::pow(step / 0.5, 4.0) : 0.0;
    return {ramp({1.0e-2 * bob, chart, rest * std::pow(step / 0.5, rest_order)}), {}};
  }

  Attribution explain() {
    const RunVariants run = [this](const std::vector<Overrides>& variants) {
      std::vector<VariantResult> results;
      for (const Overrides& changes : variants) results.push_back(fly(changes));
      if (broken) results.front() = {{}, "it blew up"};
      flown += variants.size();
      return results;
    };
    return attribute(bundle, {"attitude_deg", 1.0, 1.0e-12}, *fly({}).error, run);
  }

  Bundle bundle;
  double rest = 0.0, rest_order = 0.0;
  bool broken = false;
  std::size_t flown = 0;
};

TEST_F(Attributing, DividesADifferenceAndMeasuresEveryLaw) {
  const Attribution found = explain();
  ASSERT_EQ(found.causes.size(), 2u);
  EXPECT_TRUE(found.complete);
  for (const AttributedCause& cause : found.causes) {
    EXPECT_NEAR(cause.share, 0.5, 1e-12);  // 1e-6 across 1e-6
    EXPECT_NEAR(cause.maximum_without, 1.0e-6, 1e-18);
    ASSERT_TRUE(cause.law);
    EXPECT_NEAR(cause.law->exponent, cause.cause.key == "bob_inertia" ? 1.0 : 4.0, 1e-9);
  }
  EXPECT_EQ(found.causes.back().maximum_left, 0.0);
  EXPECT_EQ(found.kind, Remainder::kRounding);
  EXPECT_EQ(conclusion(found, bundle.model).find("the bob inertia (50.0 %; linear in bob inertia"),
            0u);
  EXPECT_THAT(conclusion(found, bundle.model), HasSubstr(" and the attitude chart (50.0 %"));
  // Two alone, both, both at half the step; two of the bob, two of the step; none of them twice.
  EXPECT_EQ(flown, 8u);
}

TEST_F(Attributing, SaysWhatNoCauseCarries) {
  rest = 1.0e-5;
  const Attribution found = explain();
  EXPECT_EQ(found.kind, Remainder::kUnexplained);
  EXPECT_NEAR(*found.remainder_order, 0.0, 1e-12);
  EXPECT_NEAR(found.remainder, 1.0e-5, 1e-17);
  EXPECT_THAT(conclusion(found, bundle.model), HasSubstr("not explained by any cause"));
}

TEST_F(Attributing, KnowsTheIntegratorByItsOrder) {
  rest = 1.0e-5;
  rest_order = 2.0;
  const Attribution found = explain();
  EXPECT_EQ(found.kind, Remainder::kIntegrator);
  EXPECT_THAT(remainder_words(found), HasSubstr("second order in the step, 2.00"));
}

TEST_F(Attributing, KeepsGoingWhenAVariantCanNotBeFlown) {
  broken = true;
  const Attribution found = explain();
  EXPECT_FALSE(found.complete);
  EXPECT_EQ(found.failure, "it blew up");
  EXPECT_EQ(found.causes.size(), 2u);
  EXPECT_TRUE(std::isnan(found.causes.back().share));
  EXPECT_FALSE(std::isnan(found.causes.front().share));
}

TEST_F(Attributing, SaysNothingOfARemainderThatWasNotRun) {
  const RunVariants interrupted = [](const std::vector<Overrides>&) {
    return std::vector<VariantResult>();
  };
  const Attribution found =
      attribute(bundle, {"attitude_deg", 1.0, 1.0e-12}, *fly({}).error, interrupted);
  EXPECT_FALSE(found.complete);
  EXPECT_EQ(found.kind, Remainder::kUnknown);
  EXPECT_EQ(found.causes.front().no_law, "not run to the end");
  EXPECT_THAT(conclusion(found, bundle.model), HasSubstr("interrupted"));
}

TEST_F(Attributing, LooksAtNoCauseOfRounding) {
  bundle.model.engines.bob_inertia = 0.0;
  const RunVariants none = [](const std::vector<Overrides>&) -> std::vector<VariantResult> {
    ADD_FAILURE() << "a variant was run";
    return {};
  };
  const Attribution found =
      attribute(bundle, {"attitude_deg", 1.0, 1.0e-12}, ramp({1.0e-13, 0.0, 0.0}), none);
  EXPECT_TRUE(found.is_rounding);
  EXPECT_TRUE(found.complete);
}

TEST(Causes, AreThoseThatApply) {
  const auto keys = [](const Bundle& bundle) {
    std::vector<std::string> names;
    for (const Cause& cause : causes_of(bundle)) names.push_back(cause.key);
    return names;
  };
  Bundle bundle;
  bundle.model = test::model_of_every_kind();
  EXPECT_THAT(keys(bundle), ElementsAre("attitude_chart"));
  bundle.model.engines.attitude = AttitudeChart::kQuaternion;
  EXPECT_THAT(keys(bundle), ElementsAre());
  bundle.model.engines.frame = MujocoFrame::kInertial;
  bundle.model.engines.particle_inertia = 1.0e-6;
  bundle.model.gravity = {4.0e14, GravityLaw::kSystemCom, GravityLaw::kBodyGradient};
  EXPECT_THAT(keys(bundle),
              ElementsAre("velocity_artefact", "particle_inertia", "gravity_application"));
  EXPECT_THAT(causes_of(bundle).back().remove, ElementsAre("engines.bsm.gravity=body_gradient"));
}

TEST(StepScaling, KeepsTheInstantsThatAreCompared) {
  Model model;
  model.simulation.step = 0.04;
  model.simulation.record = 0.1;  // no multiple: recorded at 0.12, 0.2, 0.32, ...
  EXPECT_THAT(step_scaling(model, 0.5).front().set,
              ElementsAre("simulation.step=0.02", "simulation.record=0.04"));
  model.simulation.record = 0.4;
  EXPECT_EQ(step_scaling(model, 0.5).front().set.back(), "simulation.record=0.4");
  model.simulation.method = Method::kRkf45;
  EXPECT_TRUE(step_scaling(model, 0.5).empty());
}

}  // namespace
}  // namespace twincraft
