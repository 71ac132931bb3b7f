// The point mass in both engines: one law, no attitude, three slides.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/bsm/engine.h"
#include "runtime/compare/agreement.h"
#include "runtime/compare/conservation.h"
#include "runtime/compare/proof.h"
#include "runtime/mujoco/engine.h"
#include "runtime/reference/reference.h"
#include "runtime/study/member.h"
#include "tests/support/asked.h"
#include "tests/support/compiled.h"

namespace twincraft {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Off its centre, pushed along a skew line that changes, in orbit.
Bundle compiled(const std::vector<std::string>& overrides = {}) {
  return test::compiled_file("tests/golden/point_mass.yaml", overrides);
}

TEST(PointMass, IsPulledByGravityWhereItsMassIsAndPushedByItsLoads) {
  const Bundle bundle = compiled();
  const Model& model = bundle.model;
  const auto bsm = make_bsm_engine(model);
  const auto mujoco = make_mujoco_engine(model, bundle.text(kMjcf));
  for (const RandomState& state : random_states(model, 20)) {
    const Vector3d r = state.r_BN_N + Vector3d(0.1, -0.2, 0.05);
    Vector3d expected = -model.gravity.mu / std::pow(r.norm(), 3) * r;
    if (state.time < 30.0) expected += Vector3d(3.0, -6.0, 9.0) / 750.0;
    for (Engine* engine : {bsm.get(), mujoco.get()}) {
      EXPECT_EQ(engine->layout().size(), 6);
      EXPECT_LT((test::accelerations_at(model, *engine, state) - expected).norm(),
                1e-14 * expected.norm());
    }
  }
}

TEST(PointMass, IsProvedToBeOneMachine) {
  for (const char* frame : {"comoving", "inertial"}) {
    const ProofReport proof = prove(compiled({std::string("engines.mujoco.frame=") + frame}));
    EXPECT_TRUE(proof.pass()) << to_text(proof);
    EXPECT_THAT(to_text(proof), HasSubstr("3 and 3"));
  }
}

TEST(PointMass, SlidesOnThreeJoints) {
  const std::string mjcf = compiled().text(kMjcf);
  EXPECT_THAT(mjcf, Not(HasSubstr("freejoint")));
  EXPECT_THAT(mjcf, HasSubstr(R"(<joint name="hub.y" type="slide" axis="0 1 0"/>)"));
  EXPECT_THAT(mjcf, HasSubstr(R"(qpos="0 0 0" qvel="0 0 0")"));
}

TEST(PointMass, BalancesItsBooksAndShowsNoAttitude) {
  const Bundle bundle = compiled();
  for (const auto& engine :
       {make_bsm_engine(bundle.model), make_mujoco_engine(bundle.model, bundle.text(kMjcf))}) {
    const Trajectory run = propagate(*engine, bundle.model);
    ASSERT_EQ(run.status, Trajectory::Status::kComplete) << run.failure;
    const Observation& last = run.samples.back();
    EXPECT_EQ(last.q_BN.w(), 1.0);
    EXPECT_EQ(last.omega_BN_B, Vector3d::Zero());
    const Conservation kept = conservation_of(run);
    EXPECT_LT(kept.energy, 1e-12);  // rk4 at 1 s on an orbit of 5800 s
    EXPECT_LT(kept.momentum, 1e-12);
    EXPECT_EQ(kept.angular_momentum, 0.0);
  }
}

TEST(PointMass, IsComparedWithoutAttitude) {
  const Bundle bundle = compiled();
  const auto run = [&bundle](std::unique_ptr<Engine> engine) {
    return propagate(*engine, bundle.model);
  };
  const Comparison comparison = compare(bundle.model, run(make_bsm_engine(bundle.model)),
                                        run(make_mujoco_engine(bundle.model, bundle.text(kMjcf))));
  std::vector<std::string> keys;
  for (const Metric& metric : comparison.metrics) keys.push_back(metric.key);
  EXPECT_THAT(keys,
              testing::ElementsAre("position_m", "velocity_m_s", "com_position_m", "mass_kg"));
  Member member;
  member.comparison = comparison;
  member.complete = true;
  EXPECT_EQ(member.verdict(), Verdict::kAgree);
}

TEST(PointMass, KeepsItsErrorControlWithAnAdaptiveMethod) {
  const Bundle bundle = compiled({"simulation.integrator=rkf78", "simulation.tolerance=1.0e-12",
                                  "loads=null", "simulation.step=60 s"});
  const auto engine = make_bsm_engine(bundle.model);
  const Trajectory run = propagate(*engine, bundle.model);
  ASSERT_EQ(run.status, Trajectory::Status::kComplete) << run.failure;
  EXPECT_FALSE(inapplicable(ReferenceKind::kKepler, bundle.model, bundle.model.gravity.bsm));
  EXPECT_TRUE(inapplicable(ReferenceKind::kSpinUp, bundle.model, bundle.model.gravity.bsm));
  const std::vector<Deviation> off = deviations(ReferenceKind::kKepler, bundle.model, run.samples);
  EXPECT_LT(off.front().max, 1e-6);  // [m] of 7000 km
}

}  // namespace
}  // namespace twincraft
