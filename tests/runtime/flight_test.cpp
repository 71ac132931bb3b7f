// Flights of the real engines: pieces give the bytes of the whole, a snapshot is gone on from to
// the bit, and driving an input with what its schedule says changes nothing.
#include "runtime/simulate/flight.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "compiler/ir/signals.h"
#include "runtime/simulate/engines.h"
#include "tests/support/compiled.h"

namespace twincraft {
namespace {

using State = std::vector<double>;

/// Two tanks that drain, slosh, a panel and gravity: what a flight has to keep in mind.
Bundle burn() { return test::compiled_file("tests/components/vehicles/burn.yaml"); }

State state_of(const Flight& flight) { return {flight.state().begin(), flight.state().end()}; }

State flown(Flight& flight) {
  while (!flight.done()) flight.advance();
  return state_of(flight);
}

std::size_t port_of(const Model& model, const std::string& name) {
  const std::vector<std::string> names = component_names(inputs_of(model));
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

/// A model in which nothing acts by schedule.
Bundle without_schedules(Bundle bundle) {
  Model& model = bundle.model;
  for (Link& link : model.assembly.links) link.joint.effort = {};
  for (Rotor& rotor : model.assembly.rotors) rotor.torque = {};
  for (Load& load : model.loads) {
    load.force_L = load.torque_L = load.force_M = load.torque_M = {};
    if (load.thruster) load.thruster->thrust = {};
  }
  for (Tank& tank : model.tanks) tank.mass_flow = {};
  for (Nozzle& nozzle : model.nozzles) nozzle.mass_flow = {};
  return bundle;
}

class Flights : public testing::TestWithParam<EngineKind> {
 protected:
  std::unique_ptr<Engine> engine(const Bundle& bundle) const {
    return make_engine(GetParam(), bundle);
  }
};

/// One engine's attitude is an MRP, the other's a quaternion.
TEST_P(Flights, HaveANameForEveryEntryOfTheState) {
  const Bundle bundle = burn();
  const auto engine = this->engine(bundle);
  const StateLayout& layout = engine->layout();
  const std::vector<std::string> names = component_names(states_of(bundle.model, layout.chart));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(layout.size()));
  EXPECT_EQ(names.at(static_cast<std::size_t>(layout.rate())), "omega_BN_B.x");
  EXPECT_EQ(names.at(static_cast<std::size_t>(layout.joint())), "wing.1.position");
}

TEST_P(Flights, InPiecesThatEndOnTheGridGiveTheBytesOfOne) {
  const Bundle bundle = burn();
  const auto a = engine(bundle), b = engine(bundle);
  Flight whole(*a, bundle.model), pieces(*b, bundle.model);
  for (const double time : {0.02, 0.02, 2.0, 3.14, 7.0, 10.0}) pieces.advance_to(time);
  EXPECT_TRUE(pieces.done());
  EXPECT_EQ(state_of(pieces), flown(whole));
}

TEST_P(Flights, EndExactlyWhereTheyAreSentAndReturnToTheGrid) {
  const Bundle bundle = burn();
  const auto engine = this->engine(bundle);
  Flight flight(*engine, bundle.model);
  flight.advance_to(1.0 / 3.0);
  EXPECT_EQ(flight.time(), 1.0 / 3.0);
  flight.advance();
  EXPECT_EQ(flight.time(), 17 * bundle.model.simulation.step);
  flight.advance_to(1.0e9);
  EXPECT_EQ(flight.time(), bundle.model.simulation.duration);
}

TEST_P(Flights, GoOnForeverWithoutAnEnd) {
  const Bundle bundle = burn();
  const auto engine = this->engine(bundle);
  Flight flight(*engine, bundle.model, {.has_end = false});
  flight.advance_to(2.0 * bundle.model.simulation.duration);
  EXPECT_EQ(flight.time(), 2.0 * bundle.model.simulation.duration);
  EXPECT_FALSE(flight.done());
}

TEST_P(Flights, GoOnFromASnapshotToTheBit) {
  const Bundle bundle = burn();
  const auto a = engine(bundle), b = engine(bundle);
  Flight flight(*a, bundle.model, {.keeps_books = true});
  Flight other(*b, bundle.model, {.keeps_books = true});
  flight.advance_to(3.7);
  flight.drive(port_of(bundle.model, "kicker.thrust"), 25.0);
  flight.advance_to(5.03);  // between landings, with a driven input, in the middle of a burn
  const Flight::Snapshot snapshot = flight.snapshot();
  other.advance_to(8.5);
  other.restore(snapshot);
  EXPECT_EQ(other.time(), 5.03);
  EXPECT_EQ(flown(other), flown(flight));
  EXPECT_EQ(other.books().work, flight.books().work);
  EXPECT_EQ(other.counts().evaluations, flight.counts().evaluations);
  flight.restore(snapshot);
  EXPECT_EQ(flown(flight), state_of(other));
}

/// The engine that goes on was built of a model in which nothing ever flows.
TEST_P(Flights, GoOnFromASnapshotThatHasSpentWhatNoScheduleTakes) {
  const Bundle bundle = without_schedules(burn());
  const auto a = engine(bundle), b = engine(bundle);
  Flight flight(*a, bundle.model), other(*b, bundle.model);
  const std::size_t thrust = port_of(bundle.model, "main_engine.thrust");
  flight.drive(thrust, 10.0 * 20.0 * kStandardGravity);  // 10 kg/s
  flight.advance_to(4.0);
  flight.drive(thrust, 0.0);
  other.restore(flight.snapshot());
  EXPECT_EQ(b->observe(5.0, other.state()).mass, a->observe(5.0, flight.state()).mass);
  EXPECT_NEAR(b->observe(5.0, other.state()).mass, 1050.0 - 40.0, 1e-9);
  EXPECT_EQ(flown(other), flown(flight));
}

TEST_P(Flights, DrivenWithZerosWhereTheScheduleIsZeroHaveTheSameBytes) {
  Bundle bundle = burn();
  bundle.model.loads.push_back({"push", 0, {}, {}, Vector3d(0.1, 0.2, 0.3)});
  const auto a = engine(bundle), b = engine(bundle);
  Flight left_alone(*a, bundle.model), driven(*b, bundle.model);
  for (const char* name : {"push.force.x", "push.force.y", "push.force.z", "push.torque.y"})
    driven.drive(port_of(bundle.model, name), 0.0);
  EXPECT_EQ(flown(driven), flown(left_alone));
}

/// What acts by schedule in one flight is fed live to another whose schedules are empty: every kind
/// of port, on mounts that are turned.
TEST_P(Flights, FedLiveWithTheirScheduleHaveTheSameBytes) {
  for (const char* vehicle : {"burn", "ports", "jet"}) {
    const Bundle bundle =
        test::compiled_file(std::string("tests/components/vehicles/") + vehicle + ".yaml");
    const Bundle bare = without_schedules(bundle);
    const auto a = engine(bundle), b = engine(bare);
    Flight scheduled(*a, bundle.model), live(*b, bare.model);
    InputFeed schedule(bundle.model);
    const std::size_t ports = ports_of(bundle.model).size();
    const auto feed = [&](double time) {
      schedule.begin(time);
      for (std::size_t port = 0; port < ports; ++port) live.drive(port, schedule.value(port));
    };
    feed(0.0);
    for (const double time : input_events(bundle.model)) {
      live.advance_to(time);
      feed(time);
    }
    EXPECT_NE(live.inputs().tanks.front().spent, 0.0);
    EXPECT_EQ(flown(live), flown(scheduled)) << vehicle;
  }
}

/// One of two thrusters is driven, the other goes on by its schedule.
TEST_P(Flights, SumUpWhatDrivenAndScheduledThrustersTakeFromOneTank) {
  const Bundle bundle =
      test::compiled_file("tests/components/vehicles/burn.yaml", {"thrusters.kicker.tank=fuel"});
  const auto engine = this->engine(bundle);
  Flight flight(*engine, bundle.model);
  flight.drive(port_of(bundle.model, "main_engine.thrust"), 100.0);
  flight.advance_to(4.0);
  const double driven = 100.0 / (20.0 * kStandardGravity), kicker = 30.0 / (2.0 * kStandardGravity);
  EXPECT_NEAR(flight.inputs().tanks.front().content(4.0), 500.0 - 4.0 * driven - 2.0 * kicker,
              1e-10);
}

TEST_P(Flights, FollowTheScheduleAgainWhenAnInputIsReleased) {
  const Bundle bundle = burn();
  const auto engine = this->engine(bundle);
  Flight flight(*engine, bundle.model);
  const int flow = flight.inputs().layout.tank_flow(0);
  const std::size_t thrust = port_of(bundle.model, "main_engine.thrust");
  const double scheduled = flight.inputs()[flow];
  flight.advance_to(1.0);
  flight.drive(thrust, 0.0);
  flight.advance_to(2.5);
  EXPECT_EQ(flight.inputs().tanks.front().content(2.5), 500.0 - scheduled);
  flight.release(thrust);
  EXPECT_EQ(flight.inputs()[flow], scheduled);
  EXPECT_EQ(flight.input(thrust), 2000.0);
  flight.advance_to(4.0);
  EXPECT_DOUBLE_EQ(flight.inputs().tanks.front().content(4.0), 500.0 - 2.5 * scheduled);
}

/// 200 kg at 10 kg/s last 20 s, whatever the grid; what is driven afterwards finds nothing.
TEST_P(Flights, StopTheEnginesOfATankThatRunsEmpty) {
  const Bundle bundle = burn();
  const auto engine = this->engine(bundle);
  Flight flight(*engine, bundle.model, {.has_end = false});
  const std::size_t thrust = port_of(bundle.model, "kicker.thrust");
  flight.drive(thrust, 10.0 * 2.0 * kStandardGravity);
  flight.advance_to(19.99);
  EXPECT_NEAR(flight.inputs().tanks.at(1).content(19.99), 0.1, 1e-9);
  EXPECT_GT(flight.input(thrust), 0.0);
  flight.advance_to(25.0);
  EXPECT_EQ(flight.inputs().tanks.at(1).content(25.0), 0.0);
  EXPECT_EQ(flight.input(thrust), 0.0);
  flight.drive(thrust, 1.0);
  EXPECT_EQ(flight.input(thrust), 0.0);
  flight.advance_to(26.0);
  const Observation seen = engine->observe(26.0, flight.state());
  EXPECT_TRUE(std::isfinite(seen.omega_BN_B.norm()));
}

INSTANTIATE_TEST_SUITE_P(Of, Flights, testing::Values(EngineKind::kBsm, EngineKind::kMujoco),
                         [](const auto& param_info) {
                           return std::string(name_of(param_info.param).key);
                         });

}  // namespace
}  // namespace twincraft
