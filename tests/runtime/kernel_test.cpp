// Claims about the kernel's scalars: every instruction set gives the same accelerations, every lane
// of a batch those of a single spacecraft, and sines are good to the last digits.
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/integrate/runge_kutta.h"
#include "runtime/scalar/lanes.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/kernel_of.h"

namespace twincraft {
namespace {

using bsm::InstructionSet;
using test::KernelOf;
using test::OracleState;

TEST(Lanes, HaveSinesGoodToTheLastDigits) {
  using portable::Pair;
  double worst = 0.0;
  for (int i = -20000; i < 20000; ++i) {
    const double angle = 1.2345e-2 * i;
    Pair pair(angle);
    portable::set_lane(pair, 1, 1000.0 * angle);
    const auto [sine, cosine] = portable::sine_cosine(pair);
    for (const std::size_t lane : {0u, 1u}) {
      const double at = portable::lane(pair, lane);
      worst = std::max(worst, std::abs(portable::lane(sine, lane) - std::sin(at)));
      worst = std::max(worst, std::abs(portable::lane(cosine, lane) - std::cos(at)));
    }
  }
  EXPECT_LT(worst, 2.3e-16);  // one digit in the last place of a number below one
}

TEST(Lanes, HaveTheSameSinesWhateverTheOthersAre) {
  using portable::Pair;
  for (int i = -2000; i <= 2000; ++i) {
    const double angle = 3.9e-4 * i;  // below pi / 4
    const auto [sine, cosine] = portable::sine_cosine(Pair(angle));
    EXPECT_LE(std::abs(portable::lane(sine, 0) - std::sin(angle)), 1.2e-16);
    EXPECT_LE(std::abs(portable::lane(cosine, 0) - std::cos(angle)), 1.2e-16);
    for (const double other : {1.2, 2.0, 200.0, 1e5, std::nan("")}) {
      Pair pair(angle);
      portable::set_lane(pair, 1, other);
      const auto [other_sine, other_cosine] = portable::sine_cosine(pair);
      EXPECT_EQ(portable::lane(other_sine, 0), portable::lane(sine, 0)) << angle << other;
      EXPECT_EQ(portable::lane(other_cosine, 0), portable::lane(cosine, 0)) << angle << other;
    }
  }
}

TEST(InstructionSets, GiveTheSameAccelerations) {
  std::mt19937_64 random(41);
  for (int trial = 0; trial < 100; ++trial) {
    const Assembly assembly = test::random_assembly(random, 1 + trial % 10, trial % 3);
    const OracleState state = test::random_state(random, assembly);
    const Gravity gravity{1.0e4, GravityLaw::kBodyGradient, GravityLaw::kNone};
    const bsm::HeldInputs held = test::inputs_of(assembly);
    const Vector3d r_BN(30.0, -40.0, 20.0);
    KernelOf portable(assembly, ChainPath::kPlanar, gravity, InstructionSet::kPortable);
    const Eigen::VectorXd expected = portable.accelerations(state, held, r_BN);
    for (const InstructionSet set : bsm::instruction_sets()) {
      KernelOf other(assembly, ChainPath::kPlanar, gravity, set);
      EXPECT_LT((other.accelerations(state, held, r_BN) - expected).norm(), 1e-12 * expected.norm())
          << name_of(set);
    }
  }
}

/// Many spacecraft of one structure, in lanes.
struct Fleet {
  std::vector<Assembly> assemblies;
  std::vector<OracleState> states;
  std::vector<bsm::Plan> plans;
  std::vector<bsm::HeldInputs> held;
  std::vector<const bsm::Plan*> plan_of;
  std::vector<const bsm::HeldInputs*> held_of;

  /// @param drains  the first element of every link does, in each spacecraft as fast as it likes
  Fleet(std::size_t count, int joints, int rotors, unsigned seed, bool drains = false) {
    for (std::size_t l = 0; l < count; ++l) {
      // The same numbers but for what differs between the lanes: masses and places.
      std::mt19937_64 random(seed);
      Assembly assembly = test::random_assembly(random, joints, rotors);
      std::mt19937_64 other(seed + 1 + l);
      std::uniform_real_distribution<double> uniform(0.5, 1.5);
      for (Link& link : assembly.links) {
        const double scale = uniform(other);
        for (MassElement& element : link.elements) {
          element.mass *= scale;
          element.I_PntE_L *= scale;
        }
        link.joint.r_HP_P += test::random_vector(other, 0.1);
        if (drains) link.elements.front().tank = 0;
      }
      states.push_back(test::random_state(other, assembly));
      held.push_back(test::inputs_of(assembly));
      if (drains)
        held.back().inputs.tanks = {
            {.full = 10.0, .spent = uniform(other), .since = -0.1, .flow = uniform(other)}};
      plans.push_back(bsm::make_plan(assembly, AttitudeChart::kMrp, gravity(), {}));
      assemblies.push_back(std::move(assembly));
    }
    for (const bsm::Plan& plan : plans) plan_of.push_back(&plan);
    for (const bsm::HeldInputs& inputs : held) held_of.push_back(&inputs);
  }
  static Gravity gravity() { return {1.0e4, GravityLaw::kBodyCom, GravityLaw::kNone}; }
};

class KernelOde final : public Ode {
 public:
  KernelOde(bsm::Kernel& kernel, int size) : kernel_(kernel), size_(size) {}
  int size() const override { return size_; }
  void derivative(double time, std::span<const double> state, std::span<double> rate) override {
    kernel_.derivative(time, state.data(), rate.data());
  }
  void finish_step(std::span<double> state) override { kernel_.finish_step(state.data()); }

 private:
  bsm::Kernel& kernel_;
  int size_;
};

/// One second of RK4 from these states, spacecraft by spacecraft at i * lanes + l.
Eigen::VectorXd flown(bsm::Kernel& kernel, const Eigen::VectorXd& initial) {
  KernelOde ode(kernel, static_cast<int>(initial.size()));
  RungeKutta stepper(kRk4, ode);
  std::copy(initial.begin(), initial.end(), stepper.state().begin());
  for (int step = 0; step < 100; ++step) stepper.step(0.01 * step, 0.01);
  return Eigen::VectorXd::Map(stepper.state().data(), initial.size());
}

Eigen::VectorXd side_by_side(const Fleet& fleet, const Vector3d& r_BN_N) {
  const auto lanes = static_cast<Eigen::Index>(fleet.states.size());
  Eigen::MatrixXd states(lanes, test::kernel_state(fleet.states[0], r_BN_N).size());
  for (Eigen::Index l = 0; l < lanes; ++l)
    states.row(l) =
        test::kernel_state(fleet.states[static_cast<std::size_t>(l)], r_BN_N).transpose();
  return states.reshaped();
}

void expect_every_lane_flies_alone(const InstructionSet set, bool drains) {
  const Vector3d r_BN(30.0, -40.0, 20.0);
  const std::size_t lanes = bsm::batch_lanes(set);
  const Fleet fleet(lanes, 6, 2, 43, drains);
  const auto batch = bsm::make_batch_kernel(fleet.plan_of, set);
  ASSERT_EQ(batch->lanes(), lanes);
  batch->hold(fleet.held_of);
  const Eigen::VectorXd ends = flown(*batch, side_by_side(fleet, r_BN));
  const Eigen::Index size = ends.size() / static_cast<Eigen::Index>(lanes);
  for (std::size_t l = 0; l < lanes; ++l) {
    const auto single = bsm::make_kernel(fleet.plans[l], set);
    single->hold({&fleet.held_of[l], 1});
    const Eigen::VectorXd end = flown(*single, test::kernel_state(fleet.states[l], r_BN));
    const Eigen::VectorXd ours =
        ends.reshaped(static_cast<Eigen::Index>(lanes), size).row(static_cast<Eigen::Index>(l));
    EXPECT_LT((ours - end).norm(), 1e-14 * end.norm()) << name_of(set) << ", lane " << l;
  }
}

TEST(Batch, FliesEveryLaneAsASingleSpacecraft) {
  for (const InstructionSet set : bsm::instruction_sets())
    expect_every_lane_flies_alone(set, false);
}

TEST(Batch, HasTanksOfItsOwnInEveryLane) {
  for (const InstructionSet set : bsm::instruction_sets()) expect_every_lane_flies_alone(set, true);
}

Eigen::Vector<double, 8> numbers_of(const BookRates& rates) {
  Eigen::Vector<double, 8> numbers;
  numbers << rates.power, rates.own_power, rates.force_N, rates.torque_PntC_N;
  return numbers;
}

TEST(Batch, BooksEveryLaneAsASingleSpacecraft) {
  const Vector3d r_BN(30.0, -40.0, 20.0);
  for (const InstructionSet set : bsm::instruction_sets()) {
    const Fleet fleet(bsm::batch_lanes(set), 6, 2, 47, true);
    const auto batch = bsm::make_batch_kernel(fleet.plan_of, set);
    batch->hold(fleet.held_of);
    const Eigen::VectorXd states = side_by_side(fleet, r_BN);
    Eigen::VectorXd rates(states.size());
    std::vector<BookRates> books(fleet.plans.size());
    batch->derivative_to_book(0.5, states.data(), rates.data(), books.data());
    batch->settle_books();
    for (std::size_t l = 0; l < books.size(); ++l) {
      const auto single = bsm::make_kernel(fleet.plans[l], set);
      single->hold({&fleet.held_of[l], 1});
      const Eigen::VectorXd state = test::kernel_state(fleet.states[l], r_BN);
      BookRates alone;
      single->derivative_to_book(0.5, state.data(), rates.data(), &alone);
      single->settle_books();
      const Eigen::Vector<double, 8> expected = numbers_of(alone);
      EXPECT_GT(expected.cwiseAbs().minCoeff(), 0.0);
      EXPECT_LT((numbers_of(books[l]) - expected).norm(), 1e-13 * expected.norm())
          << name_of(set) << ", lane " << l;
    }
  }
}

TEST(Batch, TakesNothingFromTheHeapInADerivativeOrItsBooks) {
  const InstructionSet set = bsm::fastest_instruction_set(bsm::Use::kBatch);
  const Fleet fleet(bsm::batch_lanes(set), 6, 2, 47, true);
  const auto batch = bsm::make_batch_kernel(fleet.plan_of, set);
  batch->hold(fleet.held_of);
  const Eigen::Index size = test::kernel_state(fleet.states[0]).size();
  Eigen::VectorXd state =
      Eigen::VectorXd::Constant(size * static_cast<Eigen::Index>(fleet.plans.size()), 0.1);
  Eigen::VectorXd rate(state.size());
  std::vector<BookRates> books(fleet.plans.size());
  const long before = test::allocation_count();
  for (int i = 0; i < 10; ++i) {
    batch->derivative_to_book(0.0, state.data(), rate.data(), books.data());
    batch->settle_books();
    batch->finish_step(state.data());
  }
  EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace twincraft
