// See stage_sums.h. The number of terms of a sum is a template argument, so that its weights are in
// registers. Only what lives in the namespace of a set may come out of this file:
// tests/architecture looks.  Tested by tests/runtime/runge_kutta_test.cpp.
#include "runtime/integrate/stage_sums.h"

#include <cstring>
#include <utility>

namespace twincraft::TWINCRAFT_SUMS {
namespace {

constexpr std::size_t kLanes = TWINCRAFT_SUM_LANES;
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));

// As std::vector and Eigen align numbers, which any x86-64 can then load while it computes.
constexpr std::size_t kAlignment = 16;

Lanes load(const double* from) {
  Lanes lanes;
  std::memcpy(&lanes, __builtin_assume_aligned(from, kAlignment), sizeof lanes);
  return lanes;
}
void store(const Lanes& lanes, double* to) {
  std::memcpy(__builtin_assume_aligned(to, kAlignment), &lanes, sizeof lanes);
}

/// The last stage has just been written, number by number: a wider load would have to wait until
/// they have left the store buffer.
Lanes load_one_by_one(const volatile double* from) {
  Lanes lanes{};
#pragma GCC unroll 8
  for (std::size_t lane = 0; lane < kLanes; ++lane) lanes[lane] = from[lane];
  return lanes;
}

/// The weighted stages of a sum. @tparam kIsWhole  whether the last is written as wide as it is
/// read
template <std::size_t kTerms, bool kIsWhole>
class Terms {
 public:
  Terms(const WeightedSum& sum, double h, const double* stages) {
#pragma GCC unroll 16
    for (std::size_t term = 0; term < kTerms; ++term) {
      weight_.data()[term] = h * sum.coefficient.data()[term];
      k_.data()[term] = stages + sum.offset.data()[term];
    }
  }
  Lanes at(std::size_t i) const {
    constexpr std::size_t kLast = kTerms - 1;
    const double* newest = k_.data()[kLast] + i;
    const Lanes last = weight_.data()[kLast] * (kIsWhole ? load(newest) : load_one_by_one(newest));
    if constexpr (kLast == 0) return last;
    Lanes total = weight_.data()[0] * load(k_.data()[0] + i);
#pragma GCC unroll 16
    for (std::size_t term = 1; term < kLast; ++term)
      total += weight_.data()[term] * load(k_.data()[term] + i);
    return total + last;
  }

 private:
  std::array<double, kTerms> weight_;
  std::array<const double*, kTerms> k_;
};

template <std::size_t kTerms, bool kIsWhole>
void add(const WeightedSum& sum, double h, const double* stages, const double* base,
         double* result) {
  const Terms<kTerms, kIsWhole> terms(sum, h, stages);
#pragma GCC unroll 2
  for (std::size_t i = 0, end = sum.padded_size; i < end; i += kLanes)
    store(load(base + i) + terms.at(i), result + i);
}

/// Zero times a finite number is zero; times infinity or NaN it is NaN, which no sum forgets.
bool are_zero(const Lanes& lanes) {
  double sum = 0.0;
#pragma GCC unroll 8
  for (std::size_t lane = 0; lane < kLanes; ++lane) sum += lanes[lane];
  return sum == 0.0;
}

template <std::size_t kTerms, bool kIsWhole>
bool add_compensated(const WeightedSum& sum, double h, const double* stages,
                     const Compensated<const double>& base, const Compensated<double>& result) {
  const Terms<kTerms, kIsWhole> terms(sum, h, stages);
  const auto [value, carry] = base;
  const auto [new_value, new_carry] = result;
  Lanes zeros{};
#pragma GCC unroll 2
  for (std::size_t i = 0, end = sum.padded_size; i < end; i += kLanes) {
    const Lanes before = load(value + i);
    const Lanes increment = terms.at(i) + load(carry + i);
    const Lanes after = before + increment;
    store(after, new_value + i);
    store(increment - (after - before), new_carry + i);
    zeros += 0.0 * after;
  }
  return are_zero(zeros);
}

template <bool kIsWhole, std::size_t... kIndex>
constexpr StageSums sums_of(std::index_sequence<kIndex...> /*terms*/) {
  return {{&add<kIndex + 1, kIsWhole>...}, {&add_compensated<kIndex + 1, kIsWhole>...}};
}

using Indices = std::make_index_sequence<Tableau::kMaxStages>;
constexpr StageSums kOneByOne = sums_of<false>(Indices());
constexpr StageSums kWhole = sums_of<true>(Indices());

}  // namespace

const StageSums& stage_sums(bool is_written_whole) { return is_written_whole ? kWhole : kOneByOne; }

}  // namespace twincraft::TWINCRAFT_SUMS
