// Claims about the Jacobians of the analytic engine, against Richardson's extrapolation of central
// differences of the engine itself, and about the tape that they are made of.
#include "runtime/bsm/jacobian.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

#include "runtime/bsm/engine.h"
#include "runtime/bsm/recording.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/asked.h"
#include "tests/support/compiled.h"
#include "tests/support/kernel_in_scalars.h"

namespace twincraft {
namespace {

using bsm::Jacobian;
using test::span_of;

struct Vehicle {
  std::string name, file;
  std::vector<std::string> overrides = {};
};

std::ostream& operator<<(std::ostream& out, const Vehicle& vehicle) { return out << vehicle.name; }

class Jacobians : public testing::TestWithParam<Vehicle> {
 protected:
  const Bundle bundle_ = test::compiled_file(GetParam().file, GetParam().overrides);
  const Model& model_ = bundle_.model;
  const std::unique_ptr<Engine> engine_ = make_bsm_engine(model_, bsm::InstructionSet::kPortable);
  bsm::Differentiator differentiator_{model_};
  const std::vector<RandomState> states_ = random_states(model_, 5);

  Eigen::VectorXd packed(const RandomState& state) const { return pack(state, engine_->layout()); }
  Jacobian jacobian(const Inputs& inputs, double time, const Eigen::VectorXd& x) {
    Jacobian jacobian;
    differentiator_.hold(inputs);
    differentiator_.differentiate(time, span_of(x), jacobian);
    return jacobian;
  }
  Eigen::VectorXd rate(const Inputs& inputs, double time, const Eigen::VectorXd& x) {
    engine_->hold(inputs);
    return test::derivative_at(*engine_, time, x);
  }

  /// How much of each state is a small change.
  Eigen::VectorXd changes(const Eigen::VectorXd& x) const {
    const StateLayout& at = engine_->layout();
    Eigen::VectorXd change = Eigen::VectorXd::Constant(x.size(), 0.01);
    change.head<3>().setConstant(0.002 * (1.0 + x.head<3>().norm()));
    change.segment<3>(StateLayout::velocity()).setConstant(1.0);
    if (at.wheels > 0) change.tail(at.wheels).setConstant(10.0);
    return change;
  }
};

/// d f / d h at h = 0: what central differences with h, h/2 and h/4 tend to, but for h^6.
template <class Function>
Eigen::VectorXd slope(const Function& f, double h) {
  const auto central = [&f](double step) -> Eigen::VectorXd {
    return (f(step) - f(-step)) / (2.0 * step);
  };
  const Eigen::VectorXd d1 = central(h), d2 = central(0.5 * h), d4 = central(0.25 * h);
  const Eigen::VectorXd e2 = (4.0 * d2 - d1) / 3.0, e4 = (4.0 * d4 - d2) / 3.0;
  return (16.0 * e4 - e2) / 15.0;
}

/// The largest error of a column's entry, against the largest that a change of any state makes of
/// the same rate.
double error(const Eigen::VectorXd& expected, const Eigen::VectorXd& found, double change,
             const Eigen::VectorXd& rows) {
  return ((expected - found) * change).cwiseQuotient(rows).cwiseAbs().maxCoeff();
}

TEST_P(Jacobians, AreThoseOfExtrapolatedDifferences) {
  double worst = 0.0;
  for (const RandomState& state : states_) {
    const Eigen::VectorXd x = packed(state), change = changes(x);
    const Inputs inputs = inputs_at(model_, state.time);
    const Jacobian ours = jacobian(inputs, state.time, x);
    ASSERT_EQ(ours.A.rows(), x.size());
    ASSERT_EQ(ours.A.cols(), x.size());
    ASSERT_EQ(static_cast<std::size_t>(ours.B.cols()), inputs.u.size());
    const Eigen::VectorXd rows =
        (ours.A * change.asDiagonal()).cwiseAbs().rowwise().maxCoeff().cwiseMax(1e-12);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const Eigen::VectorXd expected = slope(
          [&](double h) {
            Eigen::VectorXd moved = x;
            moved[i] += h;
            return rate(inputs, state.time, moved);
          },
          change[i]);
      worst = std::max(worst, error(expected, ours.A.col(i), change[i], rows));
    }
    for (std::size_t k = 0; k < inputs.u.size(); ++k) {
      const bool is_flow = static_cast<int>(k) >= inputs.layout.tank_flow(0);
      const double by = is_flow ? 0.1 * inputs.u[k] : 1.0;
      const Eigen::VectorXd found = ours.B.col(static_cast<Eigen::Index>(k));
      if (by == 0.0) {
        EXPECT_TRUE(found.isZero(0.0)) << "input " << k;
        continue;
      }
      const Eigen::VectorXd expected = slope(
          [&](double h) {
            Inputs moved = inputs;
            moved.u[k] += h;
            return rate(moved, state.time, x);
          },
          by);
      const Eigen::VectorXd all = rows.cwiseMax((found * by).cwiseAbs());
      worst = std::max(worst, error(expected, found, by, all));
    }
  }
  RecordProperty("worst", testing::PrintToString(worst));
  EXPECT_LT(worst, 1e-9);
}

TEST_P(Jacobians, AreThoseOfTheKernelOverDuals) {
  if (model_.simulation.translation) GTEST_SKIP() << "a point mass has no kernel";
  for (const RandomState& state : states_) {
    const Eigen::VectorXd x = packed(state), change = changes(x);
    const Inputs inputs = inputs_at(model_, state.time);
    const Jacobian ours = jacobian(inputs, state.time, x);
    const Jacobian duals = test::jacobian_in_duals(model_, inputs, state.time, x);
    // Sums in another order: some digits of the largest term of a row.
    const Eigen::VectorXd rows =
        (ours.A * change.asDiagonal()).cwiseAbs().rowwise().maxCoeff().cwiseMax(1e-12);
    const Eigen::MatrixXd apart = (ours.A - duals.A) * change.asDiagonal();
    EXPECT_LT((rows.cwiseInverse().asDiagonal() * apart).cwiseAbs().maxCoeff(), 1e-12);
    for (Eigen::Index k = 0; k < ours.B.cols(); ++k)
      EXPECT_LE((ours.B.col(k) - duals.B.col(k)).norm(), 1e-12 * duals.B.col(k).norm());
  }
}

TEST_P(Jacobians, AreTakenWithoutTheHeap) {
  const Eigen::VectorXd x = packed(states_.front());
  Jacobian jacobian;
  differentiator_.differentiate(0.0, span_of(x), jacobian);
  const long before = test::allocation_count();
  for (const double time : {0.0, 0.5}) differentiator_.differentiate(time, span_of(x), jacobian);
  EXPECT_EQ(test::allocation_count(), before);
}

/// The inputs of a tape of this model.
std::vector<double> tape_inputs(const Model& model, const Inputs& inputs, double time,
                                const Eigen::VectorXd& x) {
  const bsm::RecordedInputs at(model);
  std::vector<double> in(at.size());
  in[bsm::RecordedInputs::time()] = time;
  std::ranges::copy(x, in.begin() + static_cast<std::ptrdiff_t>(at.state(0)));
  at.put(inputs, in);
  return in;
}

/// Inputs of which none is zero, so that no way is left out that a tape takes.
Inputs all_acting(Inputs inputs) {
  for (std::size_t i = 0; i < inputs.u.size(); ++i)
    if (inputs.u[i] == 0.0) inputs.u[i] = 0.1 + 0.01 * static_cast<double>(i);
  return inputs;
}

TEST_P(Jacobians, ComeFromATapeThatHasTheBytesOfTheKernel) {
  if (model_.simulation.translation) GTEST_SKIP() << "a point mass has no kernel";
  const Tape tape = bsm::recorded_derivative(model_), fewer = tape.simplified();
  EXPECT_LT(fewer.operations(), tape.operations());
  for (const RandomState& state : states_) {
    const Eigen::VectorXd x = packed(state);
    const Inputs inputs = all_acting(inputs_at(model_, state.time));
    const std::vector<double> in = tape_inputs(model_, inputs, state.time, x);
    const Eigen::VectorXd expected = test::rate_in_doubles(model_, inputs, state.time, x);
    Eigen::VectorXd replayed(x.size()), short_way(x.size());
    const auto size = static_cast<std::size_t>(x.size());
    tape.replay(in, {replayed.data(), size});
    fewer.replay(in, {short_way.data(), size});
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(replayed[i]),
                std::bit_cast<std::uint64_t>(expected[i]))
          << "rate " << i << ": " << replayed[i] << ", " << expected[i];
      EXPECT_EQ(short_way[i], expected[i]) << "rate " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, Jacobians,
    testing::Values(Vehicle{"RwPanels", "models/paper/rw_panels.yaml"},
                    Vehicle{"Gravity", "models/paper/orbit_extended.yaml"},
                    Vehicle{"GravityInQuaternions",
                            "models/paper/orbit_extended.yaml",
                            {"engines.bsm.attitude=quaternion"}},
                    Vehicle{"TanksAndSlosh", "models/paper/variable_mass.yaml"},
                    Vehicle{"Jets", "tests/components/vehicles/jet.yaml"},
                    Vehicle{"Ports", "tests/components/vehicles/ports.yaml"},
                    Vehicle{"Branches", "tests/components/vehicles/arm_in_orbit.yaml"},
                    Vehicle{"Particle", "tests/components/vehicles/particle.yaml"},
                    Vehicle{"Pendulum", "tests/components/vehicles/pendulum.yaml"},
                    Vehicle{"Chains", "models/paper/flex_panels.yaml", {"panels.*.segments=8"}},
                    Vehicle{"RigidBody", "models/paper/torque.yaml"},
                    Vehicle{"PointMass", "tests/golden/point_mass.yaml"}),
    [](const auto& each) { return each.param.name; });

TEST(Jacobian, IsTheSameOnThePlanarAndOnTheGeneralWay) {
  Bundle bundle = test::compiled_file("models/paper/flex_panels.yaml", {"panels.*.segments=8"});
  Model& model = bundle.model;
  bsm::Differentiator planar(model);
  model.engines.chains = ChainPath::kGeneral;
  bsm::Differentiator general(model);
  for (const RandomState& state : random_states(model, 5)) {
    const Inputs inputs = inputs_at(model, state.time);
    const Eigen::VectorXd x = pack(state, make_bsm_engine(model)->layout());
    Jacobian a, b;
    for (auto [of, to] : {std::pair{&planar, &a}, std::pair{&general, &b}}) {
      of->hold(inputs);
      of->differentiate(state.time, span_of(x), *to);
    }
    EXPECT_LT((a.A - b.A).cwiseAbs().maxCoeff(), 1e-10 * a.A.cwiseAbs().maxCoeff());
    EXPECT_LT((a.B - b.B).cwiseAbs().maxCoeff(), 1e-10 * a.B.cwiseAbs().maxCoeff());
  }
}

}  // namespace
}  // namespace twincraft
