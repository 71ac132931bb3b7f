// The derivative of the analytic engine, differentiated: exact to rounding, by the kernel's own
// text over numbers that know their partial derivatives (runtime/scalar/dual.h).
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "compiler/ir/inputs.h"
#include "compiler/ir/model.h"

namespace twincraft::bsm {

/// Of the rate of an engine's state, in the coordinates of that state (runtime/engine/state.h): a
/// chart is differentiated as it is, four components of a quaternion each by itself.
struct Jacobian {
  Eigen::MatrixXd A;  // d(rate)/d(state)
  Eigen::MatrixXd B;  // d(rate)/d(u), u as InputLayout says
};

/// What tanks have lost is no function of the inputs of an instant, so the flow out of a tank has a
/// column of zeros; a nozzle's has what its jet does. A nozzle without a flow has none: there the
/// law of the jet bends.
class Differentiator {
 public:
  explicit Differentiator(const Model& model);
  ~Differentiator();

  /// Hold these inputs from now on, as an engine does; it is built with those of t = 0.
  void hold(const Inputs& inputs);
  /// Set all of `jacobian` at `time` [s]. Takes nothing from the heap when it has been used before.
  void differentiate(double time, std::span<const double> state, Jacobian& jacobian);

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace twincraft::bsm
