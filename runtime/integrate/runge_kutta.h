// The one stepper of both engines: any explicit Runge-Kutta tableau on a flat state vector.
// A tableau's zeros are dropped once, at construction; a step then is its evaluations and one pass
// over the state per stage, without allocation. The sum of all steps is compensated (Kahan), so
// that rounding does not grow with their number. Every entry of the state goes through the same
// operations whatever its neighbours are, so quadratures appended behind a state leave its
// trajectory bitwise unchanged.  Tested by tests/runtime/runge_kutta_test.cpp.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "runtime/integrate/stage_sums.h"
#include "runtime/integrate/tableau.h"

namespace twincraft {

/// What is stepped: y' = f(t, y), and a touch-up of y after each accepted step.
class Ode {
 public:
  virtual ~Ode() = default;
  virtual int size() const = 0;
  /// How many of them derivative() reads: quadratures lie behind.
  virtual int read_size() const { return size(); }
  virtual void derivative(double time, std::span<const double> state, std::span<double> rate) = 0;
  /// All rates of a step have been asked for. Those of quadratures may be set as late as here.
  virtual void finish_rates() {}
  virtual void finish_step(std::span<double> state) = 0;
  /// How its rates may be summed.
  virtual StageAccess access() const { return {}; }
};

class RungeKutta {
 public:
  /// `tableau` and `ode` must outlive the stepper; the state starts at zero.
  RungeKutta(const Tableau& tableau, Ode& ode);

  const Tableau& tableau() const { return tableau_; }
  int size() const { return size_; }
  std::span<double> state() { return {state_.value.data(), static_cast<std::size_t>(size_)}; }

  /// A state and what is still to be added to it: too small for its last digit.
  struct Solution {
    Eigen::VectorXd value;
    Eigen::VectorXd carry;
  };
  /// Where it is, to be gone on from by any stepper of the same method and size, to the bit.
  const Solution& solution() const { return state_; }
  void go_on_from(const Solution& solution) { state_ = solution; }

  /// Start anew from `state`: nothing is carried over from earlier steps.
  void restart(std::span<const double> state);

  /// Advance state() from `time` to `time + h` [s] by one step.
  void step(double time, double h);

  /// The same with an embedded pair, but state() stays: proposal() is the solution to propagate
  /// and error() its difference from the comparison solution. accept() makes the proposal the
  /// state.
  void attempt(double time, double h);
  void accept();
  std::span<const double> proposal() const { return entries(proposal_.value); }
  std::span<const double> error() const { return entries(error_); }

  /// As the last step() or accept(), or attempt(), left them.
  bool state_is_finite() const { return state_is_finite_; }
  bool proposal_is_finite() const { return proposal_is_finite_; }

  /// After a step whose result is not finite: the entry that failed first, by stage.
  int first_non_finite() const;

 private:
  /// @param size  of the sum, without padding
  WeightedSum weighted_sum(const Tableau::Row& coefficients, int size) const;
  void evaluate_stages(double time, double h);
  std::span<const double> entries(const Eigen::VectorXd& padded) const {
    return {padded.data(), static_cast<std::size_t>(size_)};
  }
  static Compensated<const double> in(const Solution& solution) {
    return {solution.value.data(), solution.carry.data()};
  }
  static Compensated<double> out(Solution& solution) {
    return {solution.value.data(), solution.carry.data()};
  }

  const Tableau& tableau_;
  Ode& ode_;
  int size_;
  int padded_size_;  // every vector is zero-padded to whole lanes
  std::vector<WeightedSum> stage_sums_;
  WeightedSum solution_sum_;
  WeightedSum error_sum_;
  Eigen::VectorXd stages_;  // k_i, one after another
  Eigen::VectorXd trial_;
  Solution state_;
  Solution proposal_;
  bool state_is_finite_ = true, proposal_is_finite_ = true;
  Eigen::VectorXd error_;
  Eigen::VectorXd zero_;
};

}  // namespace twincraft
