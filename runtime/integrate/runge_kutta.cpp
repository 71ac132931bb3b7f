// See runge_kutta.h.  Tested by tests/runtime/runge_kutta_test.cpp.
#include "runtime/integrate/runge_kutta.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace twincraft {
namespace {

constexpr int kLanes = WeightedSum::kLanes;

int whole_lanes(int size) { return (size + kLanes - 1) / kLanes * kLanes; }

Tableau::Row difference(const Tableau::Row& left, const Tableau::Row& right) {
  Tableau::Row result{};
  std::transform(left.begin(), left.end(), right.begin(), result.begin(), std::minus<>());
  return result;
}

const StageSums& sums_for(const Ode& ode) {
  const auto [has_avx2, written_at_once] = ode.access();
  return has_avx2 ? sums_avx2::stage_sums(written_at_once >= 4)
                  : sums_x86_64::stage_sums(written_at_once >= 2);
}

}  // namespace

WeightedSum RungeKutta::weighted_sum(const Tableau::Row& coefficients, int size) const {
  WeightedSum sum{.padded_size = static_cast<std::size_t>(whole_lanes(size))};
  std::size_t terms = 0;
  for (std::size_t stage = 0; stage < coefficients.size(); ++stage) {
    if (coefficients[stage] == 0.0) continue;
    sum.coefficient[terms] = coefficients[stage];
    sum.offset[terms] = stage * static_cast<std::size_t>(padded_size_);
    ++terms;
  }
  if (terms == 0) return sum;  // the first stage, which is never summed
  const StageSums& sums = sums_for(ode_);
  sum.add = sums.add[terms - 1];
  sum.add_compensated = sums.add_compensated[terms - 1];
  return sum;
}

RungeKutta::RungeKutta(const Tableau& tableau, Ode& ode)
    : tableau_(tableau),
      ode_(ode),
      size_(ode.size()),
      padded_size_(whole_lanes(size_)),
      solution_sum_(weighted_sum(tableau.b, size_)),
      stages_(Eigen::VectorXd::Zero(tableau.stages * padded_size_)),
      trial_(Eigen::VectorXd::Zero(padded_size_)),
      state_{trial_, trial_},
      proposal_{trial_, trial_},
      error_(trial_),
      zero_(trial_) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(tableau.stages); ++i)
    stage_sums_.push_back(weighted_sum(tableau.a[i], ode.read_size()));
  if (tableau.adaptive) error_sum_ = weighted_sum(difference(tableau.b, tableau.b_hat), size_);
}

void RungeKutta::evaluate_stages(double time, double h) {
  const auto size = static_cast<std::size_t>(size_);
  const double* state = state_.value.data();
  const double* stages = stages_.data();
  double* k = stages_.data();
  ode_.derivative(time, {state, size}, {k, size});
  std::size_t stage = 0;
  for (const WeightedSum& sum : std::span<const WeightedSum>(stage_sums_).subspan(1)) {
    ++stage;
    k += padded_size_;
    sum.add(sum, h, stages, state, trial_.data());
    ode_.derivative(time + tableau_.c[stage] * h, {trial_.data(), size}, {k, size});
  }
  ode_.finish_rates();
}

void RungeKutta::restart(std::span<const double> state) {
  std::ranges::copy(state, state_.value.begin());
  state_.carry.setZero();
}

void RungeKutta::step(double time, double h) {
  evaluate_stages(time, h);
  state_is_finite_ =
      solution_sum_.add_compensated(solution_sum_, h, stages_.data(), in(state_), out(state_));
  ode_.finish_step(state());
}

void RungeKutta::attempt(double time, double h) {
  evaluate_stages(time, h);
  proposal_is_finite_ =
      solution_sum_.add_compensated(solution_sum_, h, stages_.data(), in(state_), out(proposal_));
  error_sum_.add(error_sum_, h, stages_.data(), zero_.data(), error_.data());
}

void RungeKutta::accept() {
  std::swap(state_, proposal_);
  state_is_finite_ = proposal_is_finite_;
  ode_.finish_step(state());
}

int RungeKutta::first_non_finite() const {
  const auto first_in = [this](const double* vector) {
    const double* end = vector + size_;
    const double* found = std::find_if_not(vector, end, [](double x) { return std::isfinite(x); });
    return found == end ? size_ : static_cast<int>(found - vector);
  };
  for (Eigen::Index k = 0; k < stages_.size(); k += padded_size_) {
    const int index = first_in(stages_.data() + k);
    if (index < size_) return index;
  }
  return std::min(first_in(proposal_.value.data()), first_in(state_.value.data()));
}

}  // namespace twincraft
