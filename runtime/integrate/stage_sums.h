// The stepper's inner loops: weighted sums of the stages of a step. Compiled for any x86-64 and for
// AVX2, both without fused products, so that they give the same bytes.
// Tested by tests/runtime/runge_kutta_test.cpp.
#pragma once

#include <array>
#include <cstddef>

#include "runtime/integrate/tableau.h"

namespace twincraft {

/// How stages may be read. None of it is in the bytes of a sum.
struct StageAccess {
  bool has_avx2 = false;  // the processor, and whose stages they are may use it
  /// How many numbers one store has written, the first of them at a multiple of as many.
  std::size_t written_at_once = 1;
};

/// A value and what is still to be added to it. @tparam T  double or const double
template <class T>
struct Compensated {
  T* value;
  T* carry;
};

/// h * sum of coefficient * stage, over the non-zero coefficients only, added to a base.
struct WeightedSum {
  /// Every vector is padded to a multiple of these.
  static constexpr std::size_t kLanes = 4;

  std::array<double, Tableau::kMaxStages> coefficient{};
  std::array<std::size_t, Tableau::kMaxStages> offset{};  // of the stage in `stages`
  std::size_t padded_size = 0;

  /// result = base + h * sum
  using Add = void (*)(const WeightedSum&, double h, const double* stages, const double* base,
                       double* result);
  Add add = nullptr;
  /// The same with what rounding took away from earlier sums; result may be base.
  /// @return whether all of it is finite
  using AddTo = bool (*)(const WeightedSum&, double h, const double* stages,
                         const Compensated<const double>& base, const Compensated<double>& result);
  AddTo add_compensated = nullptr;
};

/// By the number of terms less one.
struct StageSums {
  std::array<WeightedSum::Add, Tableau::kMaxStages> add;
  std::array<WeightedSum::AddTo, Tableau::kMaxStages> add_compensated;
};

// @param is_written_whole  whether stages are written as wide as they are read
namespace sums_x86_64 {
const StageSums& stage_sums(bool is_written_whole);
}
namespace sums_avx2 {
const StageSums& stage_sums(bool is_written_whole);
}

}  // namespace twincraft
