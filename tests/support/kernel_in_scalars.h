// The analytic kernel over scalars that no run uses: one number alone, and duals.
#pragma once

#include <Eigen/Core>

#include "compiler/ir/inputs.h"
#include "compiler/ir/model.h"
#include "runtime/bsm/jacobian.h"

namespace twincraft::test {

/// The rate over doubles, limb by limb.
Eigen::VectorXd rate_in_doubles(const Model& model, const Inputs& inputs, double time,
                                const Eigen::VectorXd& state);

/// The Jacobian over duals, as many columns at once as they have partial derivatives.
bsm::Jacobian jacobian_in_duals(const Model& model, const Inputs& inputs, double time,
                                const Eigen::VectorXd& state);

}  // namespace twincraft::test
