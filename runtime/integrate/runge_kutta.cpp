// The stepper's inner loops. Vectors are padded to whole lanes of four doubles and the number of
// terms of a sum is a template argument, so each sum is one straight loop without a tail, its
// weights in registers.  Tested by tests/runtime/runge_kutta_test.cpp.
#include "runtime/integrate/runge_kutta.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace twincraft {
namespace {

constexpr Eigen::Index kLanes = 4;
using Lanes = Eigen::Array<double, kLanes, 1>;
using ConstLaneMap = Eigen::Map<const Lanes, Eigen::Aligned16>;
using LaneMap = Eigen::Map<Lanes, Eigen::Aligned16>;

Eigen::Index whole_lanes(int size) { return (size + kLanes - 1) / kLanes * kLanes; }

Tableau::Row difference(const Tableau::Row& left, const Tableau::Row& right) {
  Tableau::Row result{};
  std::transform(left.begin(), left.end(), right.begin(), result.begin(), std::minus<>());
  return result;
}

}  // namespace

/// The weighted stages of a sum, four entries at a time.
template <int kTerms>
class RungeKutta::Terms {
 public:
  Terms(const WeightedSum& sum, double h, const double* stages) {
#pragma GCC unroll 16
    for (std::size_t term = 0; term < kTerms; ++term) {
      weight_[term] = h * sum.coefficient[term];
      k_[term] = stages + sum.offset[term];
    }
  }
  Lanes at(Eigen::Index i) const {
    constexpr std::size_t kLast = kTerms - 1;
    const Lanes last = weight_[kLast] * one_by_one(k_[kLast] + i);
    if constexpr (kLast == 0) return last;
    Lanes total = weight_[0] * ConstLaneMap(k_[0] + i);
#pragma GCC unroll 16
    for (std::size_t term = 1; term < kLast; ++term)
      total += weight_[term] * ConstLaneMap(k_[term] + i);
    return total + last;
  }
  /// The last stage has just been written, number by number: a wider load would have to wait until
  /// they have left the store buffer.
  static Lanes one_by_one(const volatile double* k) {
    const double k0 = k[0], k1 = k[1], k2 = k[2], k3 = k[3];
    return {k0, k1, k2, k3};
  }

 private:
  std::array<double, kTerms> weight_;
  std::array<const double*, kTerms> k_;
};

template <int kTerms>
void RungeKutta::add(const WeightedSum& sum, double h, const double* stages, const double* base,
                     double* result) {
  const Terms<kTerms> terms(sum, h, stages);
  for (Eigen::Index i = 0, end = sum.padded_size; i < end; i += kLanes)
    LaneMap(result + i) = ConstLaneMap(base + i) + terms.at(i);
}

template <int kTerms>
void RungeKutta::add_compensated(const WeightedSum& sum, double h, const double* stages,
                                 const Solution& base, Solution& result) {
  const Terms<kTerms> terms(sum, h, stages);
  const double* value = base.value.data();
  const double* carry = base.carry.data();
  double* new_value = result.value.data();
  double* new_carry = result.carry.data();
  for (Eigen::Index i = 0, end = sum.padded_size; i < end; i += kLanes) {
    const Lanes before = ConstLaneMap(value + i);
    const Lanes increment = terms.at(i) + ConstLaneMap(carry + i);
    const Lanes after = before + increment;
    LaneMap(new_value + i) = after;
    LaneMap(new_carry + i) = increment - (after - before);
  }
}

RungeKutta::WeightedSum RungeKutta::weighted_sum(const Tableau::Row& coefficients) const {
  using Indices = std::make_index_sequence<Tableau::kMaxStages>;
  constexpr auto kAdd = []<std::size_t... kIndex>(std::index_sequence<kIndex...>) {
    return std::array<WeightedSum::Add, sizeof...(kIndex)>{&add<kIndex + 1>...};
  }
  (Indices());
  constexpr auto kAddCompensated = []<std::size_t... kIndex>(std::index_sequence<kIndex...>) {
    return std::array<WeightedSum::AddTo, sizeof...(kIndex)>{&add_compensated<kIndex + 1>...};
  }
  (Indices());

  WeightedSum sum{.padded_size = padded_size_};
  std::size_t terms = 0;
  for (std::size_t stage = 0; stage < coefficients.size(); ++stage) {
    if (coefficients[stage] == 0.0) continue;
    sum.coefficient[terms] = coefficients[stage];
    sum.offset[terms] = static_cast<Eigen::Index>(stage) * padded_size_;
    ++terms;
  }
  if (terms == 0) return sum;  // the first stage, which is never summed
  sum.add = kAdd[terms - 1];
  sum.add_compensated = kAddCompensated[terms - 1];
  return sum;
}

RungeKutta::RungeKutta(const Tableau& tableau, Ode& ode)
    : tableau_(tableau),
      ode_(ode),
      size_(ode.size()),
      padded_size_(whole_lanes(size_)),
      solution_sum_(weighted_sum(tableau.b)),
      stages_(Eigen::VectorXd::Zero(tableau.stages * padded_size_)),
      trial_(Eigen::VectorXd::Zero(padded_size_)),
      state_{trial_, trial_},
      proposal_{trial_, trial_},
      error_(trial_),
      zero_(trial_) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(tableau.stages); ++i)
    stage_sums_.push_back(weighted_sum(tableau.a[i]));
  if (tableau.adaptive) error_sum_ = weighted_sum(difference(tableau.b, tableau.b_hat));
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
}

void RungeKutta::restart(std::span<const double> state) {
  std::ranges::copy(state, state_.value.begin());
  state_.carry.setZero();
}

void RungeKutta::step(double time, double h) {
  evaluate_stages(time, h);
  solution_sum_.add_compensated(solution_sum_, h, stages_.data(), state_, state_);
  ode_.finish_step(state());
}

void RungeKutta::attempt(double time, double h) {
  evaluate_stages(time, h);
  solution_sum_.add_compensated(solution_sum_, h, stages_.data(), state_, proposal_);
  error_sum_.add(error_sum_, h, stages_.data(), zero_.data(), error_.data());
}

void RungeKutta::accept() {
  std::swap(state_, proposal_);
  ode_.finish_step(state());
}

bool RungeKutta::is_finite(const Eigen::VectorXd& padded) {
  // Zero times a finite number is zero; times infinity or NaN it is NaN, which no sum forgets.
  Lanes sum = Lanes::Zero();
  for (Eigen::Index i = 0; i < padded.size(); i += kLanes)
    sum += 0.0 * ConstLaneMap(padded.data() + i);
  return sum.sum() == 0.0;
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
