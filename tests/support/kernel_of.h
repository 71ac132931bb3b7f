// The analytic kernel of a bare assembly, for claims about accelerations alone: at the origin, with
// the hub's axes along the inertial ones unless a state is given.
#pragma once

#include "runtime/bsm/kernel.h"
#include "tests/support/dense_oracle.h"

namespace twincraft::test {

/// [A B; C D] (a, omegaDot) = (vT, vR) as printed in the back-substitution papers.
struct HubEquation {
  Eigen::Matrix<double, 6, 6> matrix;
  Eigen::Matrix<double, 6, 1> right;
};

/// What the assembly's own schedules say at t = 0, and nothing else.
bsm::HeldInputs inputs_of(const Assembly& assembly);

/// The state vector of the kernel: at `r_BN_N` [m], at rest, sigma_BN = 0.
Eigen::VectorXd kernel_state(const OracleState& state, const Vector3d& r_BN_N = Vector3d::Zero());

/// (a_B, omegaDot, qDDot, wheel rates) out of the derivative of such a state.
Eigen::VectorXd accelerations_in(const Eigen::VectorXd& rate, const OracleState& state);

class KernelOf {
 public:
  explicit KernelOf(const Assembly& assembly, ChainPath paths = ChainPath::kPlanar,
                    const Gravity& gravity = {},
                    bsm::InstructionSet set = bsm::fastest_instruction_set(bsm::Use::kOne));

  Eigen::VectorXd accelerations(const OracleState& state, const bsm::HeldInputs& held,
                                const Vector3d& r_BN_N = Vector3d::Zero());
  /// Of the last accelerations().
  HubEquation hub_equation() const;
  const bsm::Plan& plan() const { return plan_; }

 private:
  bsm::Plan plan_;
  std::unique_ptr<bsm::Kernel> kernel_;
};

}  // namespace twincraft::test
