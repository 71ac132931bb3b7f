#include "tests/support/kernel_in_scalars.h"

#include <vector>

#include "runtime/bsm/vehicle.h"
#include "runtime/scalar/dual.h"

namespace twincraft::test {
namespace {

using TWINCRAFT_KERNEL::Dual;

template <class N>
std::vector<N> rate_in(const Model& model, const bsm::InputsIn<N>& inputs, N time,
                       const std::vector<N>& state) {
  const bsm::Plan plan = bsm::make_plan(model.assembly, model.engines.attitude, model.gravity,
                                        model.loads, model.engines.chains, model.forces);
  const bsm::Plan* of = &plan;
  bsm::TWINCRAFT_KERNEL::Vehicle<N, N> vehicle({&of, 1});
  auto held = bsm::HeldInputsIn<N>::none(model.assembly);
  held.set(inputs, model.loads);
  const bsm::HeldInputsIn<N>* lane = &held;
  vehicle.hold({&lane, 1});
  std::vector<N> rate(state.size());
  vehicle.derivative(time, state.data(), rate.data());
  return rate;
}

}  // namespace

Eigen::VectorXd rate_in_doubles(const Model& model, const Inputs& inputs, double time,
                                const Eigen::VectorXd& state) {
  const std::vector<double> rate =
      rate_in<double>(model, inputs, time, {state.begin(), state.end()});
  return Eigen::VectorXd::Map(rate.data(), state.size());
}

bsm::Jacobian jacobian_in_duals(const Model& model, const Inputs& inputs, double time,
                                const Eigen::VectorXd& state) {
  const auto states = static_cast<std::size_t>(state.size()), all = states + inputs.u.size();
  Eigen::MatrixXd both(state.size(), static_cast<Eigen::Index>(all));
  for (std::size_t first = 0; first < all; first += Dual::kPartials) {
    const auto seeded = [first](double value, std::size_t column) {
      const bool is_ours = column >= first && column < first + Dual::kPartials;
      return is_ours ? Dual::variable(value, column - first) : Dual(value);
    };
    std::vector<Dual> x;
    for (std::size_t i = 0; i < states; ++i)
      x.push_back(seeded(state[static_cast<Eigen::Index>(i)], i));
    bsm::InputsIn<Dual> u(inputs);
    for (std::size_t i = 0; i < inputs.u.size(); ++i) u.u[i] = seeded(inputs.u[i], states + i);
    const std::vector<Dual> rate = rate_in<Dual>(model, u, time, x);
    for (std::size_t i = 0; i < states; ++i)
      for (std::size_t k = 0; k < Dual::kPartials && first + k < all; ++k)
        both(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(first + k)) =
            rate[i].partial(k);
  }
  return {both.leftCols(state.size()), both.rightCols(both.cols() - state.size())};
}

}  // namespace twincraft::test
