// Models by the facade: what they say of themselves, and what a spec with errors says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "tests/api/vehicles.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> names(const std::vector<Signal>& signals) {
  std::vector<std::string> all;
  for (const Signal& signal : signals) all.push_back(signal.name + " [" + signal.unit + "]");
  return all;
}

TEST(Models, NameTheirInputsInTheOrderOfTheSpec) {
  EXPECT_THAT(
      names(test::ports().inputs()),
      ElementsAre("rw.torque [N m]", "arm.torque [N m]", "rail.force [N]", "main_engine.thrust [N]",
                  "side.thrust [N]", "cold.thrust [N]", "push.force.x [N]", "push.force.y [N]",
                  "push.force.z [N]", "push.torque.x [N m]", "push.torque.y [N m]",
                  "push.torque.z [N m]", "center.force.x [N]", "center.force.y [N]",
                  "center.force.z [N]", "center.torque.x [N m]", "center.torque.y [N m]",
                  "center.torque.z [N m]"));
}

TEST(Models, NameTheirStatesPositionsFirst) {
  EXPECT_THAT(names(test::ports().states()),
              ElementsAre("r_BN_N.x [m]", "r_BN_N.y [m]", "r_BN_N.z [m]", "q_BN.w [1]",
                          "q_BN.x [1]", "q_BN.y [1]", "q_BN.z [1]", "arm.position [rad]",
                          "rail.position [m]", "v_BN_N.x [m/s]", "v_BN_N.y [m/s]", "v_BN_N.z [m/s]",
                          "omega_BN_B.x [rad/s]", "omega_BN_B.y [rad/s]", "omega_BN_B.z [rad/s]",
                          "arm.rate [rad/s]", "rail.rate [m/s]", "rw.rate [rad/s]"));
}

TEST(Models, FindVectorsAndNumbers) {
  const Model model = test::ports();
  const Range vector = model.find(TC_INPUTS, "push.torque");
  EXPECT_EQ(vector.first, 9u);
  EXPECT_EQ(vector.count, 3u);
  EXPECT_EQ(model.find(TC_OUTPUTS, "omega_BN_B.y").first, 11u);
  EXPECT_EQ(model.signals(TC_OUTPUTS).at(11).meaning,
            "hub rate relative to inertial axes, hub axes");
}

TEST(Models, NameTheNearestOfAnUnknownName) {
  try {
    (void)test::ports().find(TC_INPUTS, "push.forse");
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(), "unknown input `push.forse`; did you mean `push.force`?");
  }
}

TEST(Models, SayWhatIsWrongWithASpecAsTheTerminalDoes) {
  try {
    (void)Model::load(test::file("models/quickstart.yaml"), {"hub.mass=1 m"});
    FAIL();
  } catch (const SpecError& error) {
    EXPECT_EQ(error.status(), TC_SPEC);
    EXPECT_THAT(error.what(), HasSubstr("error[SC2007]: `mass` of hub: `1 m` is a length"));
    EXPECT_THAT(error.diagnostics(), HasSubstr("\"code\": \"SC2007\""));
  }
}

TEST(Models, SayThatAFileIsMissingAndThatAnOverrideIsNone) {
  EXPECT_THROW((void)Model::load("no/such/file.yaml"), FileError);
  EXPECT_THROW((void)Model::load(test::file("models/quickstart.yaml"), {"hub.mass"}), UsageError);
}

TEST(Models, OfTheirResolvedTextAreTheSame) {
  const Model model = test::burn();
  const Model again = Model::loads(model.resolved());
  EXPECT_EQ(again.digest(), model.digest());
  EXPECT_EQ(again.mjcf(), model.mjcf());
}

TEST(Models, WeighTheVehicleAtTheStart) {
  const MassProperties all = test::burn().mass_properties();
  EXPECT_DOUBLE_EQ(all.mass, 300.0 + 50.0 + 500.0 + 200.0);
  EXPECT_GT(all.inertia[0], 0.0);
  EXPECT_EQ(all.inertia[1], all.inertia[3]);
}

TEST(Models, RunAsTheProgramDoes) {
  const auto run = test::quickstart().run();
  EXPECT_EQ(run.verdict(), "agree");
  EXPECT_TRUE(run.passes());
  EXPECT_THAT(run.text(), HasSubstr("the engines agree"));
  EXPECT_EQ(run.samples(Engine::bsm), run.samples(Engine::mujoco));
  const std::size_t width = 1 + test::quickstart().count(TC_OUTPUTS);
  std::vector<double> rows(run.samples(Engine::bsm) * width);
  run.read(Engine::bsm, rows.data(), rows.size());
  EXPECT_EQ(rows.front(), 0.0);
  EXPECT_EQ(rows.at(rows.size() - width), 120.0);
  EXPECT_THROW(run.save(""), UsageError);
}

TEST(Models, RunWithOneEngineAndWithAVerdictThatIsNoFault) {
  const Model coarse = Model::load(test::file("models/quickstart.yaml"), {"simulation.step=0.8 s"});
  const auto run = coarse.run({Engines::bsm});
  EXPECT_EQ(run.verdict(), "unresolved");
  EXPECT_FALSE(run.passes());
  EXPECT_EQ(run.samples(Engine::mujoco), 0u);
}

TEST(Models, AreProved) {
  const auto proof = test::burn().prove();
  EXPECT_EQ(proof.verdict(), "proved");
  EXPECT_THAT(proof.text(), HasSubstr("one machine"));
  EXPECT_THAT(proof.json(), HasSubstr("twincraft-proof/1"));
}

/// The poll comes from the thread that called.
TEST(Models, EndTheirWorkWhenPolled) {
  const Model model = Model::load(test::file("models/quickstart.yaml"),
                                  {"simulation.duration=1 h", "simulation.record=1 s"});
  RunOptions options;
  const std::thread::id here = std::this_thread::get_id();
  options.context = const_cast<std::thread::id*>(&here);
  options.poll = [](void* caller) {
    EXPECT_EQ(*static_cast<std::thread::id*>(caller), std::this_thread::get_id());
    return 1;
  };
  try {
    EXPECT_EQ(model.run(options).verdict(), "interrupted");
  } catch (const Interrupted&) {  // before anything was flown
  }
  EXPECT_THROW((void)model.attribute(options), Interrupted);
}

TEST(Models, ServeManyThreadsAtOnce) {
  const Model model = test::burn();
  std::vector<std::vector<double>> ends(4);
  {
    std::vector<std::thread> threads;
    for (std::vector<double>& end : ends)
      threads.emplace_back([&model, &end] {
        Simulation sim(model, Engine::mujoco);
        sim.step(50);
        end = sim.state();
      });
    for (std::thread& thread : threads) thread.join();
  }
  for (const std::vector<double>& end : ends) EXPECT_EQ(end, ends.front());
}

}  // namespace
}  // namespace twincraft
