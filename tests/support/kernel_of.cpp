#include "tests/support/kernel_of.h"

namespace twincraft::test {

bsm::HeldInputs inputs_of(const Assembly& assembly) {
  bsm::HeldInputs held = bsm::HeldInputs::none(assembly);
  Model model;
  model.assembly = assembly;
  held.set(inputs_at(model, 0.0), {});
  return held;
}

Eigen::VectorXd kernel_state(const OracleState& state, const Vector3d& r_BN_N) {
  const auto map = [](const std::vector<double>& v) {
    return Eigen::VectorXd::Map(v.data(), static_cast<Eigen::Index>(v.size()));
  };
  Eigen::VectorXd x(12 + state.q.size() + state.q_dot.size() + state.rotor_speed.size());
  x << r_BN_N, Vector3d::Zero(), Vector3d::Zero(), state.omega_BN_B, map(state.q), map(state.q_dot),
      map(state.rotor_speed);
  return x;
}

Eigen::VectorXd accelerations_in(const Eigen::VectorXd& rate, const OracleState& state) {
  const auto joints = static_cast<Eigen::Index>(state.q.size());
  const Eigen::Index after = rate.size() - 12 - joints;
  Eigen::VectorXd all(6 + after);
  all << rate.segment<3>(3), rate.segment<3>(9), rate.tail(after);
  return all;
}

KernelOf::KernelOf(const Assembly& assembly, ChainPath paths, const Gravity& gravity,
                   bsm::InstructionSet set)
    : plan_(bsm::make_plan(assembly, AttitudeChart::kMrp, gravity, {}, paths)),
      kernel_(bsm::make_kernel(plan_, set)) {}

Eigen::VectorXd KernelOf::accelerations(const OracleState& state, const bsm::HeldInputs& held,
                                        const Vector3d& r_BN_N) {
  const bsm::HeldInputs* inputs = &held;
  kernel_->hold({&inputs, 1});
  const Eigen::VectorXd x = kernel_state(state, r_BN_N);
  Eigen::VectorXd rate(x.size());
  kernel_->derivative(0.0, x.data(), rate.data());
  return accelerations_in(rate, state);
}

HubEquation KernelOf::hub_equation() const {
  std::array<double, 42> numbers;
  kernel_->hub_equation(numbers);
  HubEquation equation;
  equation.matrix = Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(numbers.data());
  equation.right = Eigen::Map<Eigen::Matrix<double, 6, 1>>(numbers.data() + 36);
  return equation;
}

}  // namespace twincraft::test
