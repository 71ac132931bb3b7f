// The battery every component must pass, on a vehicle made of it: both engines give the same
// accelerations at random states, the hub matrix is symmetric positive definite, the books of
// energy and momentum balance, and nothing depends on where the vehicle is or how fast it drifts.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>

#include "runtime/bsm/engine.h"
#include "runtime/bsm/plan.h"
#include "runtime/compare/agreement.h"
#include "runtime/compare/conservation.h"
#include "runtime/mujoco/engine.h"
#include "runtime/simulate/propagate.h"
#include "tests/support/asked.h"
#include "tests/support/compiled.h"

namespace twincraft {
namespace {

using test::accelerations_at;
using test::compiled_file;
using test::span_of;

Bundle compiled(const std::string& vehicle, const std::vector<std::string>& overrides = {}) {
  return compiled_file("tests/components/vehicles/" + vehicle + ".yaml", overrides);
}

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// MuJoCo forms m Omega^2 r of a wheel that spins off the system's centre before it cancels: what
/// rounding then leaves of the hub's acceleration [m/s^2].
double spin_rounding(const Model& model, const RandomState& state) {
  double force = 0.0, mass = 0.0;
  for (const Link& link : model.assembly.links) {
    for (const MassElement& element : link.elements) mass += element.mass;
  }
  for (const TreeWheel& wheel : model.tree.wheels) {
    const double Omega = state.wheel_rate[static_cast<std::size_t>(wheel.rotor)];
    for (const TreeBody& body : model.tree.bodies) {
      if (body.name == wheel.joint) force += body.inertial.mass * Omega * Omega * body.pos.norm();
    }
  }
  return kEpsilon * force / mass;
}

/// Block by block, so that a large block hides no small one.
void expect_same_accelerations(const Model& model, Engine& bsm, Engine& mujoco) {
  for (const RandomState& state : random_states(model, 200)) {
    const Eigen::VectorXd a = accelerations_at(model, bsm, state);
    const Eigen::VectorXd b = accelerations_at(model, mujoco, state);
    const int joints = bsm.layout().joints, wheels = bsm.layout().wheels;
    EXPECT_LT((a - b).head<3>().norm(),
              1e-11 * b.head<3>().norm() + 2.0 * spin_rounding(model, state));
    // The hub's comes out of one solve with the joints' accelerations and rounds as they do, where
    // it is small beside them.
    EXPECT_LT((a - b).segment<3>(3).norm(),
              1e-11 * b.segment<3>(3).norm() + 4.0 * kEpsilon * b.segment(6, joints).norm());
    EXPECT_LE((a - b).segment(6, joints).norm(), 1e-11 * b.segment(6, joints).norm());
    // Across an axis that is oblique to the hub's MuJoCo forms Js Omega^2 before it cancels.
    const double Omega = Eigen::Map<const Eigen::VectorXd>(state.wheel_rate.data(), wheels).norm();
    EXPECT_LE((a - b).tail(wheels).norm(),
              1e-11 * b.tail(wheels).norm() + kEpsilon * Omega * Omega);
  }
}

class Battery : public testing::TestWithParam<const char*> {
 protected:
  Bundle bundle_ = compiled(GetParam());
  std::unique_ptr<Engine> bsm_ = make_bsm_engine(bundle_.model);
  std::unique_ptr<Engine> mujoco_ = make_mujoco_engine(bundle_.model, bundle_.text(kMjcf));
};

TEST_P(Battery, GivesTheSameAccelerationsInBothEngines) {
  expect_same_accelerations(bundle_.model, *bsm_, *mujoco_);
}

/// What the outside does is found by either engine in its own way, with its own masses.
TEST_P(Battery, BooksTheSameInBothEngines) {
  for (const RandomState& state : random_states(bundle_.model, 50)) {
    BookRates a, b;
    accelerations_at(bundle_.model, *bsm_, state, &a);
    accelerations_at(bundle_.model, *mujoco_, state, &b);
    EXPECT_NEAR(a.power, b.power, 1e-11 * (1.0 + std::abs(a.power)));
    EXPECT_NEAR(a.own_power, b.own_power, 1e-11 * (1.0 + std::abs(a.own_power)));
    EXPECT_LT((a.force_N - b.force_N).norm(), 1e-11 * (1.0 + a.force_N.norm()));
    EXPECT_LT((a.torque_PntC_N - b.torque_PntC_N).norm(), 1e-11 * (1.0 + a.torque_PntC_N.norm()));
  }
}

/// A recorded run has the very trajectory of the bare one.
TEST_P(Battery, MovesTheSameWhetherItsBooksAreKeptOrNot) {
  const auto expect_same = [this](Engine& engine) {
    for (const RandomState& state : random_states(bundle_.model, 20)) {
      BookRates books;
      const Eigen::VectorXd bare = accelerations_at(bundle_.model, engine, state);
      EXPECT_EQ(accelerations_at(bundle_.model, engine, state, &books), bare) << engine.name();
    }
  };
  expect_same(*mujoco_);
  for (const bsm::InstructionSet set : bsm::instruction_sets())
    expect_same(*make_bsm_engine(bundle_.model, set));
}

TEST_P(Battery, KeepsTheHubMatrixSymmetricPositiveDefinite) {
  for (const RandomState& state : random_states(bundle_.model, 20)) {
    const Eigen::VectorXd x = pack(state, bsm_->layout());
    const Eigen::MatrixXd M = bsm_->mass_matrix(span_of(x));
    const Eigen::VectorXd y = pack(state, mujoco_->layout());
    EXPECT_LT((M - mujoco_->mass_matrix(span_of(y))).norm(), 1e-12 * M.norm());
    EXPECT_LT((M - M.transpose()).norm(), 1e-14 * M.norm());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(M);
    EXPECT_GT(solver.eigenvalues()[0], 0.0);
  }
}

TEST_P(Battery, FeelsNothingOfACommonVelocityOrPlaceWithoutGravity) {
  Model free = bundle_.model;
  free.gravity = {};
  const auto bsm = make_bsm_engine(free);
  const auto mujoco = make_mujoco_engine(free, bundle_.text(kMjcf));
  for (RandomState state : random_states(free, 20)) {
    const Eigen::VectorXd a = accelerations_at(free, *bsm, state);
    const Eigen::VectorXd b = accelerations_at(free, *mujoco, state);
    state.r_BN_N += Vector3d(7e6, -3e6, 1e6);
    state.v_BN_N += Vector3d(-2e3, 7e3, 1e3);
    EXPECT_EQ(a, accelerations_at(free, *bsm, state));
    EXPECT_EQ(b, accelerations_at(free, *mujoco, state));
  }
}

TEST_P(Battery, BalancesItsBooks) {
  Model tight = bundle_.model;
  tight.simulation.method = Method::kRkf78;
  const Tolerance fine{1e-13, 1e-13};
  tight.simulation.tolerance = {fine, fine, fine, fine, fine, fine, fine};
  for (Engine* engine : {bsm_.get(), mujoco_.get()}) {
    const Trajectory run = propagate(*engine, tight);
    ASSERT_EQ(run.status, Trajectory::Status::kComplete) << run.failure;
    const Conservation kept = conservation_of(run);
    // The tolerance times some hundred steps.
    EXPECT_LT(kept.energy, 1e-11) << engine->name();
    EXPECT_LT(kept.momentum, 1e-11) << engine->name();
    EXPECT_LT(kept.angular_momentum, 1e-11) << engine->name();
  }
}

/// Only where truncation stands above rounding.
class Truncation : public Battery {};

TEST_P(Truncation, LeavesTheBooksToFourthOrder) {
  Bundle coarse = bundle_;
  const auto energy = [&](double step) {
    coarse.model.simulation.step = step;
    return conservation_of(propagate(*bsm_, coarse.model)).energy;
  };
  const double step = 4.0 * bundle_.model.simulation.step;
  const double ratio = energy(step) / energy(0.5 * step);
  EXPECT_GT(ratio, 12.0);  // 2^4, or 2^5 where the fourth-order term cancels
  EXPECT_LT(ratio, 80.0);
}

INSTANTIATE_TEST_SUITE_P(Components, Battery,
                         testing::Values("hub", "wheel", "panel", "chain", "damped", "gravity",
                                         "arm", "arm_in_orbit", "flex_as_bodies", "particle",
                                         "pendulum", "bob", "burn", "jet"),
                         [](const auto& param_info) { return param_info.param; });

INSTANTIATE_TEST_SUITE_P(Components, Truncation,
                         testing::Values("panel", "chain", "damped", "gravity", "arm", "pendulum",
                                         "bob"),
                         [](const auto& param_info) { return param_info.param; });

/// The paper's flexible arrays of four segments, as panels and as bodies.
class SameMachine : public testing::Test {
 protected:
  Bundle panels_ =
      compiled_file("models/paper/flex_panels.yaml",
                    {"panels.*.segments=4", "simulation.step=0.002", "simulation.record=0.1"});
  Bundle bodies_ = compiled("flex_as_bodies");
};

TEST_F(SameMachine, WrittenAsBodiesHasTheAccelerationsOfThePanels) {
  const auto a = make_bsm_engine(panels_.model), b = make_bsm_engine(bodies_.model);
  const auto c = make_mujoco_engine(bodies_.model, bodies_.text(kMjcf));
  for (const RandomState& state : random_states(panels_.model, 50)) {
    const Eigen::VectorXd of_panels = accelerations_at(panels_.model, *a, state);
    // The same numbers by the same products: only rounding of the written decimals is left.
    EXPECT_LT((accelerations_at(bodies_.model, *b, state) - of_panels).norm(),
              1e-14 * of_panels.norm());
    EXPECT_LT((accelerations_at(bodies_.model, *c, state) - of_panels).norm(),
              1e-11 * of_panels.norm());
  }
}

TEST_F(SameMachine, WrittenAsBodiesTakesThePlanarPathInAnyOrder) {
  const Model& model = bodies_.model;
  const bsm::Plan plan =
      bsm::make_plan(model.assembly, model.engines.attitude, model.gravity, model.loads);
  EXPECT_EQ(plan.planar_links(), 8u);
}

TEST_F(SameMachine, WrittenAsBodiesFliesAsThePanelsDo) {
  constexpr double kPublished = 6e-13;  // [deg] between the engines on the paper's arrays
  const auto attitude = [](const Comparison& comparison) {
    return comparison.metrics.at(0).maximum;
  };
  const auto a = make_bsm_engine(panels_.model), b = make_bsm_engine(bodies_.model);
  const auto c = make_mujoco_engine(bodies_.model, bodies_.text(kMjcf));
  const Trajectory of_panels = propagate(*a, panels_.model);
  const Trajectory of_bodies = propagate(*b, bodies_.model);
  const Comparison written = compare(bodies_.model, of_panels, of_bodies);
  ASSERT_EQ(written.metrics.at(0).key, "attitude_deg");
  EXPECT_TRUE(written.same_times);
  EXPECT_LT(attitude(written), kPublished);
  EXPECT_LT(attitude(compare(bodies_.model, of_bodies, propagate(*c, bodies_.model))), kPublished);
}

/// How much less momentum is off at half the step: sixteen times less of a fourth-order method.
double momentum_ratio(Bundle bundle) {
  const auto off = [&bundle](double step) {
    bundle.model.simulation.step = step;
    const auto engine = make_bsm_engine(bundle.model);
    return conservation_of(propagate(*engine, bundle.model)).momentum;
  };
  const double step = bundle.model.simulation.step;
  return off(2.0 * step) / off(step);
}

TEST_F(SameMachine, WrittenAsBodiesFliesAlikeByEitherPath) {
  Model general = bodies_.model;
  general.engines.chains = ChainPath::kGeneral;
  const auto a = make_bsm_engine(general), b = make_bsm_engine(bodies_.model);
  const RandomState state = random_states(general, 1).front();
  // Rounded in another order: they are two paths, and one motion.
  EXPECT_NE(accelerations_at(general, *a, state), accelerations_at(general, *b, state));
  const Comparison flown = compare(general, propagate(*a, general), propagate(*b, bodies_.model));
  ASSERT_EQ(flown.metrics.at(0).key, "attitude_deg");
  EXPECT_LT(flown.metrics.at(0).maximum, 6e-13);
}

TEST_F(SameMachine, WrittenAsBodiesKeepsMomentumToTheOrderOfTheIntegrator) {
  EXPECT_NEAR(momentum_ratio(bodies_), 16.0, 4.0);
}

/// Branches, a slide and a fixed wrist, a wheel on one tip and a jet on the other.
class BranchedArm : public testing::Test {
 protected:
  Bundle bundle_ = compiled_file("models/gallery/branched_arm.yaml");
};

TEST_F(BranchedArm, HasTheSameAccelerationsInBothEngines) {
  const auto bsm = make_bsm_engine(bundle_.model);
  const auto mujoco = make_mujoco_engine(bundle_.model, bundle_.text(kMjcf));
  expect_same_accelerations(bundle_.model, *bsm, *mujoco);
}

TEST_F(BranchedArm, KeepsMomentumToTheOrderOfTheIntegrator) {
  EXPECT_NEAR(momentum_ratio(bundle_), 16.0, 4.0);
}

/// Limits: a component that vanishes must leave the vehicle without it.
TEST(Limits, APanelOfVanishingMassLeavesTheHubAlone) {
  const Bundle with = compiled("panel", {"panels.*.mass=1.0e-9",
                                         "panels.wing_p.inertia=[3.0e-9, "
                                         "2.0e-9, 1.2e-9]",
                                         "panels.*.stiffness=0"});
  const Bundle without = compiled("panel", {"panels=null"});
  const auto engine = make_bsm_engine(with.model);
  const auto bare = make_bsm_engine(without.model);
  const Eigen::VectorXd a = accelerations_at(with.model, *engine, undisturbed(with.model));
  const Eigen::VectorXd b = accelerations_at(without.model, *bare, undisturbed(without.model));
  // The panel's mass and inertia are 1e-11 of the hub's.
  const Vector3d omega_dot = b.segment<3>(3);
  EXPECT_LT((a.segment<3>(3) - omega_dot).norm(), 1e-9 * omega_dot.norm());
  EXPECT_GT(omega_dot.norm(), 1e-6);
}

TEST(Limits, AWheelWithoutMotorOrSpinIsDeadWeight) {
  const Bundle with = compiled("wheel", {"wheels.*.torque=0", "wheels.*.speed=0"});
  const auto engine = make_bsm_engine(with.model);
  const RandomState state = undisturbed(with.model);
  const Eigen::VectorXd a = accelerations_at(with.model, *engine, state);
  // A free wheel keeps its absolute spin about its axis: OmegaDot = -g . omegaDot.
  for (std::size_t k = 0; k < with.model.assembly.rotors.size(); ++k) {
    const double expected = -with.model.assembly.rotors[k].axis_L.dot(a.segment<3>(3));
    EXPECT_NEAR(a[6 + static_cast<Eigen::Index>(k)], expected, 1e-15);
  }
}

}  // namespace
}  // namespace twincraft
