// Simulations by the facade, in both engines: time, inputs, snapshots, faults.
#include "runtime/api/include/twincraft/simulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include "tests/api/vehicles.h"

namespace twincraft {
namespace {

using testing::HasSubstr;

class Simulations : public testing::TestWithParam<Engine> {
 protected:
  Simulation of(const Model& model) const { return Simulation(model, GetParam()); }
};

template <class Body>
std::string refusal(const Body& body) {
  try {
    body();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST_P(Simulations, StepFromGridPointToGridPoint) {
  Simulation sim = of(test::burn());
  sim.run_until(0.05);
  EXPECT_EQ(sim.time(), 0.05);
  sim.step();
  EXPECT_EQ(sim.time(), 3 * 0.02);
  sim.step(97);
  EXPECT_EQ(sim.time(), 2.0);  // where a schedule changes, too
}

TEST_P(Simulations, EndExactlyWhereTheyAreSent) {
  Simulation sim = of(test::quickstart());
  EXPECT_EQ(sim.run_until(1.0 / 3.0), 1.0 / 3.0);
  EXPECT_EQ(sim.run_until(1.0 / 3.0), 1.0 / 3.0);
  EXPECT_THAT(refusal([&] { sim.run_until(0.1); }), HasSubstr("t = 0.1 s is over"));
  EXPECT_THAT(refusal([&] { sim.run_until(std::nan("")); }), HasSubstr("finite"));
  EXPECT_EQ(sim.time(), 1.0 / 3.0);
}

TEST_P(Simulations, InPiecesGiveTheBytesOfOne) {
  Simulation whole = of(test::burn()), pieces = of(test::burn());
  whole.run_until(10.0);
  pieces.step(150);
  pieces.run_until(7.0);
  pieces.step(150);
  EXPECT_EQ(pieces.state(), whole.state());
}

TEST_P(Simulations, HoldADrivenInputUntilItIsReleased) {
  Simulation sim = of(test::burn());
  const std::size_t thrust = sim.model().find(TC_INPUTS, "main_engine.thrust").first;
  EXPECT_EQ(sim.inputs().at(thrust), 2000.0);
  sim.drive("main_engine.thrust", "0.5 kN");
  EXPECT_EQ(sim.inputs().at(thrust), 500.0);
  sim.run_until(7.0);  // past the schedule's change
  EXPECT_EQ(sim.inputs().at(thrust), 500.0);
  sim.release("main_engine.thrust");
  EXPECT_EQ(sim.inputs().at(thrust), 900.0);
}

TEST_P(Simulations, DrivenWithWhatTheScheduleSaysHaveItsBytes) {
  Simulation scheduled = of(test::ports()), live = of(test::ports());
  const std::vector<double> now = live.inputs();
  live.drive(0, now.data(), now.size());
  for (const double time : {0.5, 1.0}) {
    scheduled.run_until(time);
    live.run_until(time);
    const std::vector<double> next = scheduled.inputs();
    live.drive(0, next.data(), next.size());
  }
  scheduled.run_until(2.0);
  live.run_until(2.0);
  EXPECT_EQ(live.state(), scheduled.state());
}

TEST_P(Simulations, RefuseInputsThatAreNone) {
  Simulation sim = of(test::ports());
  const std::vector<double> before = sim.inputs();
  const double nan = std::nan("");
  EXPECT_THAT(refusal([&] { sim.drive("rw.torqe", 1.0); }), HasSubstr("did you mean `rw.torque`?"));
  EXPECT_THAT(refusal([&] { sim.drive("rw.torque", nan); }),
              HasSubstr("`rw.torque` is not finite"));
  EXPECT_THAT(refusal([&] { sim.drive("rw.torque", std::numeric_limits<double>::infinity()); }),
              HasSubstr("not finite"));
  EXPECT_THAT(refusal([&] { sim.drive("rw.torque", "1 N"); }), HasSubstr("is a force"));
  EXPECT_THAT(refusal([&] { sim.drive("push.force", 1.0); }), HasSubstr("3 numbers"));
  EXPECT_THAT(refusal([&] { sim.drive(1000, 1.0); }), HasSubstr("there is no input 1000"));
  const std::vector<double> half{1.0, nan, 2.0};
  EXPECT_THAT(refusal([&] { sim.drive(6, half.data(), 3); }), HasSubstr("`push.force.y`"));
  EXPECT_EQ(sim.inputs(), before);
}

TEST_P(Simulations, GoOnFromASnapshotToTheBit) {
  Simulation sim = of(test::burn()), other = of(test::burn());
  sim.run_until(3.7);
  sim.drive("kicker.thrust", 25.0);
  sim.run_until(5.03);
  const std::vector<std::uint8_t> bytes = sim.snapshot();
  other.restore(bytes);
  EXPECT_EQ(other.time(), 5.03);
  EXPECT_EQ(other.inputs(), sim.inputs());
  sim.run_until(10.0);
  other.run_until(10.0);
  EXPECT_EQ(other.state(), sim.state());
  EXPECT_EQ(other.snapshot(), sim.snapshot());
}

TEST_P(Simulations, RefuseSnapshotsOfOthersAndDamagedOnes) {
  const Model model = test::burn();
  Simulation sim = of(model);
  sim.step(10);
  const std::vector<std::uint8_t> bytes = sim.snapshot();
  const std::vector<double> before = sim.state();
  const auto refused = [&](const std::vector<std::uint8_t>& these) -> std::string {
    try {
      sim.restore(these);
    } catch (const SnapshotError& error) {
      return error.what();
    }
    return "nothing was refused";
  };
  EXPECT_THAT(refused({}), HasSubstr("no snapshot"));
  EXPECT_THAT(refused(of(test::ports()).snapshot()), HasSubstr("another model"));
  const Engine other = GetParam() == Engine::bsm ? Engine::mujoco : Engine::bsm;
  EXPECT_THAT(refused(Simulation(model, other).snapshot()), HasSubstr("another engine"));
  for (std::size_t at = 0; at < bytes.size(); at += 7) {
    std::vector<std::uint8_t> damaged = bytes;
    damaged[at] ^= 1u;
    EXPECT_NE(refused(damaged), "nothing was refused") << at;
    damaged.resize(at);
    EXPECT_NE(refused(damaged), "nothing was refused") << at;
  }
  EXPECT_EQ(sim.state(), before);
  EXPECT_EQ(refused(bytes), "nothing was refused");
}

TEST_P(Simulations, CopiesGoTheirOwnWay) {
  Simulation sim = of(test::burn());
  sim.drive("kicker.thrust", 3.0);
  sim.step(10);
  Simulation copy = sim;
  copy.drive("kicker.thrust", 30.0);
  copy.step(10);
  sim.step(10);
  EXPECT_NE(copy.state(), sim.state());
  Simulation same = sim;
  same.step(5);
  sim.step(5);
  EXPECT_EQ(same.state(), sim.state());
}

TEST_P(Simulations, AreAsNewWhenReset) {
  Simulation sim = of(test::burn()), fresh = of(test::burn());
  sim.drive("main_engine.thrust", 0.0);
  sim.step(100);
  sim.reset();
  EXPECT_EQ(sim.time(), 0.0);
  EXPECT_EQ(sim.inputs(), fresh.inputs());
  sim.step(100);
  fresh.step(100);
  EXPECT_EQ(sim.state(), fresh.state());
}

TEST_P(Simulations, GoOnFromAnotherState) {
  Simulation sim = of(test::ports());
  std::vector<double> state = sim.state();
  state.at(7) = 0.25;
  for (std::size_t i = 3; i < 7; ++i) state.at(i) *= 2.0;  // an attitude has no length
  sim.set_state(state);
  EXPECT_NEAR(sim.state().at(7), 0.25, 0.0);
  EXPECT_NEAR(sim.state().at(3), state.at(3) / 2.0, 1e-15);
  state.at(0) = std::nan("");
  EXPECT_THAT(refusal([&] { sim.set_state(state); }), HasSubstr("`r_BN_N.x` is not finite"));
  EXPECT_THAT(refusal([&] { sim.set_state({1.0}); }), HasSubstr("18 numbers, not 1"));
}

TEST_P(Simulations, CallTheirControllerAtEveryTickButTheEnd) {
  Simulation sim = of(test::quickstart());
  std::vector<double> ticks, stops;
  const double end = sim.run_until(
      0.5, 0.1, [&](double t) { ticks.push_back(t); },
      [&](double t) {
        stops.push_back(t);
        return false;
      });
  EXPECT_EQ(end, 0.5);
  EXPECT_EQ(ticks.size(), 5u);
  EXPECT_EQ(stops.size(), 6u);
  EXPECT_EQ(ticks.front(), 0.0);
  EXPECT_EQ(stops.back(), 0.5);
}

TEST_P(Simulations, StopWhenToldTo) {
  Simulation sim = of(test::quickstart());
  EXPECT_EQ(sim.run_until(10.0, 0.1, {}, [](double t) { return t > 0.25; }), 3 * 0.1);
}

TEST_P(Simulations, StandAtTheTickWhenTheirControllerThrows) {
  Simulation sim = of(test::quickstart());
  const auto bad = [](double t) {
    if (t > 0.15) throw std::range_error("mine");
  };
  EXPECT_THROW(sim.run_until(1.0, 0.1, bad), std::range_error);
  EXPECT_EQ(sim.time(), 0.2);
  EXPECT_EQ(sim.run_until(0.3), 0.3);
}

TEST_P(Simulations, LetACallbackAskAndDriveButNotMove) {
  Simulation sim = of(test::quickstart());
  sim.run_until(0.1, 0.02, [&](double t) {
    EXPECT_EQ(sim.time(), t);
    sim.drive("rw_x.torque", 0.01);
    EXPECT_THAT(refusal([&] { sim.step(); }), HasSubstr("on its way"));
  });
  EXPECT_EQ(sim.time(), 0.1);
}

TEST_P(Simulations, StandAtTheLastGoodStepEndAfterAFailure) {
  const Model model =
      Model::load(test::file("models/quickstart.yaml"), {"simulation.step=5 s"});  // far too long
  Simulation sim = of(model);
  try {
    sim.step(100'000);
    FAIL() << "it should blow up";
  } catch (const NumericalFailure& failure) {
    EXPECT_EQ(failure.time(), sim.time());
    EXPECT_THAT(failure.what(), HasSubstr("not finite"));
    for (const double x : sim.state()) EXPECT_TRUE(std::isfinite(x));
  }
  sim.reset();
  sim.step();
  EXPECT_EQ(sim.time(), 5.0);
}

TEST_P(Simulations, RefuseASecondThread) {
  Simulation sim = of(test::quickstart());
  bool was_busy = false;
  sim.run_until(0.02, 0.02, [&](double) {
    std::thread other([&] {
      try {
        sim.drive("rw_x.torque", 1.0);
      } catch (const BusyError&) {
        was_busy = true;
      }
    });
    other.join();
  });
  EXPECT_TRUE(was_busy);
  EXPECT_NE(sim.inputs().front(), 1.0);
}

TEST_P(Simulations, EndAtAStepWhenPolled) {
  Simulation sim = of(test::quickstart());
  int polls = 0;
  const tc_poll at_second = [](void* count) { return ++*static_cast<int*>(count) == 2 ? 1 : 0; };
  ASSERT_EQ(tc_simulation_set_poll(sim.handle(), at_second, &polls), TC_OK);
  EXPECT_THROW(sim.step(1'000'000), Interrupted);
  EXPECT_GT(sim.time(), 0.0);
  sim.step();
}

TEST_P(Simulations, StopWhatDrawsFromAnEmptyTank) {
  Simulation sim = of(test::burn());
  const double flow = 10.0;  // kg/s of 200 kg
  sim.drive("kicker.thrust", flow * 2.0 * 9.80665);
  sim.run_until(21.0);
  const std::size_t kicker = sim.model().find(TC_INPUTS, "kicker.thrust").first;
  EXPECT_EQ(sim.inputs().at(kicker), 0.0);
  sim.drive(kicker, 5.0);
  EXPECT_EQ(sim.inputs().at(kicker), 0.0);
  const double burnt = 6.0 * 2000.0 + 3.0 * 900.0;
  EXPECT_NEAR(sim.observe().back(), 1050.0 - 200.0 - burnt / (20.0 * 9.80665), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Of, Simulations, testing::Values(Engine::bsm, Engine::mujoco),
                         [](const auto& param_info) {
                           return param_info.param == Engine::bsm ? "bsm" : "mujoco";
                         });

}  // namespace
}  // namespace twincraft
