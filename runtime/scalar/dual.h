// A number with its partial derivatives with respect to a few variables, side by side in SIMD
// registers: a text over it gives exact derivatives of what it gives over a double, whose bytes its
// values have. It carries every derivative through every operation; where speed counts, a tape is
// differentiated instead (tangents.h).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "runtime/scalar/scalar.h"

namespace twincraft::TWINCRAFT_KERNEL {

class Dual {
 public:
  /// With respect to how many variables.
  static constexpr std::size_t kPartials = 8;

  Dual() : Dual(0.0) {}
  Dual(double constant) : value_(constant), partials_{} {}
  /// A variable, from now on that of a partial derivative.
  static Dual variable(double value, std::size_t partial) {
    Dual variable(value);
    set_lane(variable.partials_[partial / kWidth], partial % kWidth, 1.0);
    return variable;
  }

  double value() const { return value_; }
  double partial(std::size_t i) const { return lane(partials_[i / kWidth], i % kWidth); }

  Dual& operator+=(const Dual& o) { return *this = *this + o; }
  Dual& operator-=(const Dual& o) { return *this = *this - o; }
  friend Dual operator+(const Dual& a, const Dual& b) {
    return {a.value_ + b.value_, [&](std::size_t i) { return a.partials_[i] + b.partials_[i]; }};
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return {a.value_ - b.value_, [&](std::size_t i) { return a.partials_[i] - b.partials_[i]; }};
  }
  friend Dual operator-(const Dual& a) {
    return {-a.value_, [&](std::size_t i) { return -a.partials_[i]; }};
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    const Batch by_a(b.value_), by_b(a.value_);
    return {a.value_ * b.value_,
            [&](std::size_t i) { return by_a * a.partials_[i] + by_b * b.partials_[i]; }};
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double quotient = a.value_ / b.value_;
    const Batch by_a(1.0 / b.value_), by_b(quotient);
    return {quotient,
            [&](std::size_t i) { return by_a * (a.partials_[i] - by_b * b.partials_[i]); }};
  }
  friend bool operator>(const Dual& a, const Dual& b) { return a.value_ > b.value_; }
  /// The derivative is that of the side taken.
  friend Dual chosen(bool first, const Dual& a, const Dual& b) { return first ? a : b; }

  friend Dual root(const Dual& x) {
    const double value = std::sqrt(x.value_);
    return x.with(value, 0.5 / value);
  }
  friend SineCosine<Dual> sine_cosine(const Dual& angle) {
    const auto [sine, cosine] = sine_cosine(angle.value_);
    return {angle.with(sine, cosine), angle.with(cosine, -sine)};
  }

  friend Dual lane(const Dual& value, std::size_t) { return value; }
  friend void set_lane(Dual& value, std::size_t, const Dual& to) { value = to; }
  friend bool vanishes(const Dual& x) {
    bool does = x.value_ == 0.0;
    for (std::size_t i = 0; i < kPartials; ++i) does = does && x.partial(i) == 0.0;
    return does;
  }

 private:
  static constexpr std::size_t kWidth = kLanes<Batch>, kRegisters = kPartials / kWidth;
  static_assert(kPartials % kWidth == 0);

  /// @param partial  gives a register of partial derivatives
  template <class Partial>
  Dual(double value, const Partial& partial) : value_(value) {
    for (std::size_t i = 0; i < kRegisters; ++i) partials_[i] = partial(i);
  }
  /// A function of this one, by its value and its slope.
  Dual with(double value, double slope) const {
    const Batch by(slope);
    return {value, [&](std::size_t i) { return by * partials_[i]; }};
  }

  double value_;
  std::array<Batch, kRegisters> partials_;
};

static_assert(KernelScalar<Dual> && KernelScalars<Dual, Dual>);

}  // namespace twincraft::TWINCRAFT_KERNEL
