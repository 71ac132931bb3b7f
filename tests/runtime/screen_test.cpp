// Which runs are seen to be resolved without a judgement. That none of them is unresolved is
// claimed by tests/agreement/resolution_test.cpp.
#include "runtime/linear/screen.h"

#include <gtest/gtest.h>

#include <string>

#include "runtime/simulate/engines.h"
#include "runtime/simulate/propagate.h"
#include "tests/support/compiled.h"

namespace twincraft {
namespace {

bool passes(const std::string& file, std::vector<std::string> overrides = {}) {
  const Bundle bundle = test::compiled_file(file, std::move(overrides));
  const Trajectory run = propagate(*make_engine(EngineKind::kBsm, bundle), bundle.model);
  EXPECT_TRUE(run.failure.empty()) << run.failure;
  ResolutionScreen screen(bundle.model);
  for (const Observation& sample : run.samples) screen.see(sample);
  return screen.passes(run.samples.back(), run.accepted);
}

TEST(ResolutionScreen, PassesWhatHasAShortStep) {
  for (const char* model : {"models/quickstart.yaml", "models/gallery/dispersed_burn.yaml",
                            "models/gallery/dispersed_telescope.yaml", "models/gallery/tumble.yaml",
                            "models/gallery/rocket.yaml", "models/gallery/branched_arm.yaml"})
    EXPECT_TRUE(passes(model)) << model;
}

// rk4 at 0.02 s gives the panel's 1.4 rad/s some 220 steps a period.
TEST(ResolutionScreen, StopsAtAStiffSpring) {
  const std::string wing = "panels.wing_p.stiffness=";
  EXPECT_TRUE(passes("models/quickstart.yaml", {wing + "5e3 N m/rad"}));
  EXPECT_FALSE(passes("models/quickstart.yaml", {wing + "5e4 N m/rad"}));
}

TEST(ResolutionScreen, StopsAtAFastHub) {
  EXPECT_TRUE(passes("models/quickstart.yaml", {"initial.rate=[0, 0, 1]"}));
  EXPECT_FALSE(passes("models/quickstart.yaml", {"initial.rate=[0, 0, 10]"}));
}

// A motor spins a wheel up and a load holds the hub against it: no more than the angular momentum
// at the end makes the nutation fast.
TEST(ResolutionScreen, LooksAtTheEndOfTheRun) {
  const auto spun_up = [](const std::string& torque) {
    return passes("models/quickstart.yaml",
                  {"wheels.rw_z.torque=" + torque + " N m",
                   "loads=[{name: held, torque: [0, 0, " + torque + "]}]"});
  };
  EXPECT_TRUE(spun_up("1"));
  EXPECT_FALSE(spun_up("100"));
}

TEST(ResolutionScreen, StopsWhereAnAdaptiveMethodAcceptsTooMuch) {
  const std::vector<std::string> adaptive{"simulation.integrator=rkf45"};
  std::vector<std::string> loose = adaptive;
  loose.push_back("simulation.tolerance=0.1");
  EXPECT_TRUE(passes("models/quickstart.yaml", adaptive));
  loose.push_back("simulation.step=10 s");
  loose.push_back("simulation.record=10 s");
  EXPECT_FALSE(passes("models/quickstart.yaml", loose));
}

}  // namespace
}  // namespace twincraft
