// Mass that changes in flight: the rocket equation, the models that stand still at a reduced mass,
// the order of the integrator, and the swing of a pendulum under thrust.
#include <gtest/gtest.h>

#include <cmath>

#include "compiler/ir/number.h"
#include "runtime/bsm/engine.h"
#include "runtime/compare/random_state.h"
#include "runtime/mujoco/engine.h"
#include "runtime/simulate/propagate.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/compiled.h"

namespace twincraft {
namespace {

using test::compiled_file;

Bundle burn(const std::vector<std::string>& overrides = {}) {
  return compiled_file("tests/components/vehicles/burn.yaml", overrides);
}

std::vector<std::unique_ptr<Engine>> both_engines(const Bundle& bundle) {
  std::vector<std::unique_ptr<Engine>> engines;
  engines.push_back(make_bsm_engine(bundle.model));
  engines.push_back(make_mujoco_engine(bundle.model, bundle.text(kMjcf)));
  return engines;
}

Eigen::VectorXd derivative(Engine& engine, const RandomState& state) {
  const Eigen::VectorXd x = pack(state, engine.layout());
  Eigen::VectorXd rate(x.size());
  const auto size = static_cast<std::size_t>(x.size());
  engine.derivative(state.time, {x.data(), size}, {rate.data(), size});
  return rate;
}

TEST(Depletion, GivesTheRocketEquationInBothEngines) {
  const Bundle bundle = compiled_file(
      "models/paper/variable_mass.yaml",
      {"slosh=[]", "initial.rate=[0, 0, 0]", "simulation.step=1 s", "simulation.record=900 s"});
  const double exhaust = 234.0 * kStandardGravity;
  const double left = 3000.0 - 900.0 * 445.0 / exhaust;
  const double gained = exhaust * std::log(3000.0 / left);
  for (const auto& engine : both_engines(bundle)) {
    const Observation end = propagate(*engine, bundle.model).samples.back();
    EXPECT_NEAR(end.mass, left, 1e-12 * left) << engine->name();
    EXPECT_NEAR(end.v_CN_N.z(), gained, 1e-12 * gained) << engine->name();
    EXPECT_NEAR(gained, 137.54075713241858, 1e-9);
  }
}

/// A spec that starts with what is left must be the same machine as one that has burned so far.
TEST(Depletion, LeavesTheMachineOfTheReducedMass) {
  const Bundle bundle = burn();
  const double time = 5.0;
  const double fuel = bundle.model.tanks.at(0).share(time);
  const double oxidiser = bundle.model.tanks.at(1).share(time);
  const auto set = [](const std::string& path, double value) {
    return path + "=" + shortest(value);
  };
  const Bundle reduced =
      burn({set("tanks.fuel.propellant", 500.0 * fuel),
            set("tanks.oxidiser.propellant", 200.0 * oxidiser), set("slosh.blob.mass", 25.0 * fuel),
            set("slosh.bob.mass", 150.0 * fuel), set("slosh.bob.inertia", 1.5 * fuel),
            "thrusters.*.tank=null"});
  EXPECT_LT(fuel, 0.95);
  const auto draining = both_engines(bundle), standing = both_engines(reduced);
  for (RandomState state : random_states(bundle.model, 50)) {
    state.time = time;
    for (std::size_t i = 0; i < draining.size(); ++i) {
      draining[i]->hold(inputs_at(bundle.model, time));
      standing[i]->hold(inputs_at(reduced.model, time));
      const Eigen::VectorXd a = derivative(*draining[i], state);
      const Eigen::VectorXd b = derivative(*standing[i], state);
      EXPECT_LT((a - b).norm(), 1e-12 * b.norm());
      EXPECT_LT((a - b).tail(a.size() - 6).norm(), 1e-12 * b.tail(b.size() - 6).norm());
    }
  }
}

TEST(Depletion, KeepsTheOrderOfTheIntegratorAcrossIgnitionAndCutOff) {
  Bundle bundle = burn({"environment=null", "initial.orbit=null"});
  for (const auto& engine : both_engines(bundle)) {
    const auto end = [&](double step) {
      bundle.model.simulation.step = step;
      const Observation last = propagate(*engine, bundle.model).samples.back();
      Eigen::VectorXd state(9);
      state << last.omega_BN_B, last.v_BN_N,
          Vector3d(last.joint_position[0], last.joint_position[1], last.joint_position[2]);
      return state;
    };
    // 0.11 s divides neither the burns nor the run: steps are split at every event.
    const Eigen::VectorXd truth = end(0.11 / 16.0);
    const double ratio = (end(0.11) - truth).norm() / (end(0.055) - truth).norm();
    EXPECT_GT(ratio, 12.0) << engine->name();
    EXPECT_LT(ratio, 24.0) << engine->name();
  }
}

TEST(Depletion, TakesNothingFromTheHeapInADerivative) {
  const Bundle bundle = burn();
  for (const auto& engine : both_engines(bundle)) {
    const Eigen::VectorXd x = engine->initial_state();
    Eigen::VectorXd rate(x.size());
    const auto size = static_cast<std::size_t>(x.size());
    engine->derivative(0.0, {x.data(), size}, {rate.data(), size});
    const long before = test::allocation_count();
    for (int i = 0; i < 100; ++i) {
      engine->derivative(0.07 * i, {x.data(), size}, {rate.data(), size});
    }
    EXPECT_EQ(test::allocation_count() - before, 0) << engine->name();
  }
}

TEST(Depletion, ChangesNothingOfTanksThatNobodyDraws) {
  const Bundle drawn = burn(), still = burn({"thrusters=[]"});
  for (const auto& engine : both_engines(still)) {
    const auto size = static_cast<std::size_t>(engine->layout().size());
    const Eigen::VectorXd x = engine->initial_state();
    EXPECT_NEAR(engine->observe(5.0, {x.data(), size}).mass, 1050.0, 1e-9);
  }
  for (const auto& engine : both_engines(drawn)) {
    const auto size = static_cast<std::size_t>(engine->layout().size());
    const Eigen::VectorXd x = engine->initial_state();
    const double left =
        1050.0 - 5.0 * 2000.0 / (kStandardGravity * 20.0) - 3.0 * 30.0 / (kStandardGravity * 2.0);
    engine->hold(inputs_at(drawn.model, 5.0));
    EXPECT_NEAR(engine->observe(5.0, {x.data(), size}).mass, left, 1e-9);
  }
}

/// On a hub so heavy that it feels no bob, under a = F/m: omega = sqrt(a/L).
TEST(Pendulum, SwingsWithItsOwnFrequencyUnderThrust) {
  const Bundle bundle = compiled_file(
      "tests/components/vehicles/pendulum.yaml",
      {"hub.mass=1.0e9", "hub.inertia=[1.0e9, 1.0e9, 1.0e9]", "hub.center_of_mass=[0, 0, 0]",
       "initial=null", "slosh.bob.mass=1", "slosh.bob.angles=[1.0e-4, 0]", "slosh.bob.rates=[0, 0]",
       "slosh.bob.damping=0", "slosh.bob.position=[0, 0, 0]",
       "thrusters.engine.direction=[0, 0, 1]", "thrusters.engine.position=[0, 0, 0]",
       "thrusters.engine.thrust=1.0e9 N"});
  const double omega = std::sqrt(1.0 / 0.4);
  for (const auto& engine : both_engines(bundle)) {
    const RandomState state = undisturbed(bundle.model);
    const Eigen::VectorXd rate = derivative(*engine, state);
    const double phi_ddot = rate[engine->layout().joint_rate()];
    EXPECT_NEAR(std::sqrt(-phi_ddot / 1.0e-4), omega, 1e-6 * omega) << engine->name();
    const Observation end = propagate(*engine, bundle.model).samples.back();
    EXPECT_NEAR(end.joint_position[0], 1.0e-4 * std::cos(omega * end.time), 1e-10)
        << engine->name();
  }
}

}  // namespace
}  // namespace twincraft
