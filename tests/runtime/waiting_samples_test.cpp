// Samples that wait are taken in their order, each once and summed up.
#include "runtime/simulate/waiting_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/runtime/toy_engine.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Sums up three at once: its kinetic energy is a hundred times the time.
class PatientEngine : public ToyEngine {
 public:
  using ToyEngine::ToyEngine;

  std::size_t summed_at_once() const override { return 3; }
  void note(double time, std::span<const double>, Observation& seen) override {
    seen.time = time;
    seen.kinetic = -1.0;
    noted.push_back(&seen);
  }
  void sum_up_noted() override {
    for (Observation* seen : noted) seen->kinetic = 100.0 * seen->time;
    noted.clear();
  }

  std::vector<Observation*> noted;
};

class Waiting : public testing::Test {
 protected:
  void add(double time) { waiting_.add(time, state_, static_cast<int>(-time)); }
  std::vector<double> deliver(std::size_t most = 100) {
    std::vector<double> times;
    waiting_.deliver([&](const Observation& seen, int beside) {
      EXPECT_EQ(seen.kinetic, 100.0 * seen.time);
      EXPECT_EQ(beside, static_cast<int>(-seen.time));
      times.push_back(seen.time);
      return times.size() < most;
    });
    return times;
  }

  Model model_ = toy_model();
  PatientEngine engine_{model_};
  std::vector<double> state_;
  WaitingSamples<int> waiting_{engine_};
};

TEST_F(Waiting, AreTakenInTheirOrderAndOnce) {
  for (const double time : {1.0, 2.0, 3.0}) {
    EXPECT_FALSE(waiting_.is_full());
    add(time);
  }
  EXPECT_TRUE(waiting_.is_full());
  EXPECT_THAT(deliver(), ElementsAre(1.0, 2.0, 3.0));
  EXPECT_FALSE(waiting_.is_full());
  EXPECT_THAT(deliver(), IsEmpty());
  add(4.0);
  add(5.0);
  EXPECT_THAT(deliver(), ElementsAre(4.0, 5.0));
}

TEST_F(Waiting, ShowTheLastUntilAnotherIsTaken) {
  add(1.0);
  (void)deliver();
  add(2.0);
  EXPECT_EQ(waiting_.last().seen.time, 1.0);
  (void)deliver();
  EXPECT_EQ(waiting_.last().seen.time, 2.0);
  EXPECT_EQ(waiting_.last().beside, -2);
}

TEST_F(Waiting, AreForgottenWhereNoMoreAreTaken) {
  for (const double time : {1.0, 2.0, 3.0}) add(time);
  EXPECT_THAT(deliver(2), ElementsAre(1.0, 2.0));
  EXPECT_EQ(waiting_.last().seen.time, 2.0);
  EXPECT_THAT(deliver(), IsEmpty());
  add(4.0);
  EXPECT_THAT(deliver(), ElementsAre(4.0));
}

}  // namespace
}  // namespace twincraft
