// Euler's top integrated with 32 digits: Taylor series of order 34 in double-double arithmetic
// (T. J. Dekker, Numer. Math. 18 (1971) 224). Shares nothing with the closed form it judges: no
// elliptic functions, no principal axes but those given, the quaternion for an attitude.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "compiler/ir/mass.h"

namespace twincraft::test {

/// high + low, |low| at most half a unit in the last place of high.
struct DoubleDouble {
  double high = 0.0;
  double low = 0.0;
};

inline DoubleDouble normalised(double high, double low) {
  const double sum = high + low;
  return {sum, low - (sum - high)};
}

inline DoubleDouble exact_sum(double a, double b) {
  const double sum = a + b;
  const double part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

inline DoubleDouble operator-(DoubleDouble a) { return {-a.high, -a.low}; }

inline DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble high = exact_sum(a.high, b.high);
  const DoubleDouble low = exact_sum(a.low, b.low);
  const DoubleDouble sum = normalised(high.high, high.low + low.high);
  return normalised(sum.high, sum.low + low.low);
}

inline DoubleDouble operator-(DoubleDouble a, DoubleDouble b) { return a + -b; }

inline DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const double product = a.high * b.high;
  const double rest = std::fma(a.high, b.high, -product);
  return normalised(product, rest + (a.high * b.low + a.low * b.high));
}

inline DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double first = a.high / b.high;
  const DoubleDouble rest = a - DoubleDouble{first} * b;
  const double second = rest.high / b.high;
  const double third = (rest - DoubleDouble{second} * b).high / b.high;
  return normalised(first, second) + DoubleDouble{third};
}

class PreciseTop {
 public:
  PreciseTop(const Vector3d& moments, const Vector3d& omega, const Quaterniond& q) {
    for (std::size_t i = 0; i < 3; ++i) {
      const DoubleDouble own{moments[index(i)]};
      const DoubleDouble next{moments[index((i + 1) % 3)]}, last{moments[index((i + 2) % 3)]};
      coupling_[i] = (next - last) / own;
      omega_[i].fill({});
      omega_[i][0] = {omega[index(i)]};
    }
    for (auto& series : q_) series.fill({});
    q_[0][0] = {q.w()};
    for (std::size_t i = 0; i < 3; ++i) q_[i + 1][0] = {q.vec()[index(i)]};
  }

  /// Ahead by `time` [s], a multiple of a power of two, in steps that are powers of two: their sum
  /// is exact. The poles are no nearer than about 1/|omega| in the complex plane, so that the terms
  /// of a series fall by four or more, and what is left out is below 1e-22 of a rate.
  void advance(double time) {
    while (time > 0.0) {
      const double h = std::min(time, std::exp2(std::floor(std::log2(0.25 / omega().norm()))));
      step(h);
      time -= h;
    }
  }

  Vector3d omega() const { return {omega_[0][0].high, omega_[1][0].high, omega_[2][0].high}; }
  Quaterniond q() const {
    return Quaterniond(q_[0][0].high, q_[1][0].high, q_[2][0].high, q_[3][0].high).normalized();
  }

 private:
  static constexpr std::size_t kOrder = 34;
  using Series = std::array<DoubleDouble, kOrder + 1>;

  static Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

  /// Coefficient n of a product of series.
  static DoubleDouble product(const Series& a, const Series& b, std::size_t n) {
    DoubleDouble sum;
    for (std::size_t k = 0; k <= n; ++k) sum = sum + a[k] * b[n - k];
    return sum;
  }

  static DoubleDouble sum_of(const Series& series, double h) {
    DoubleDouble sum = series[kOrder];
    for (std::size_t n = kOrder; n-- > 0;) sum = sum * DoubleDouble{h} + series[n];
    return sum;
  }

  void step(double h) {
    const auto& [x, y, z] = omega_;
    auto& [qw, qx, qy, qz] = q_;
    for (std::size_t n = 0; n < kOrder; ++n) {
      const DoubleDouble count{static_cast<double>(n + 1)};
      const std::array turning{product(y, z, n), product(z, x, n), product(x, y, n)};
      const std::array moving{
          -product(qx, x, n) - product(qy, y, n) - product(qz, z, n),
          product(qw, x, n) + product(qy, z, n) - product(qz, y, n),
          product(qw, y, n) + product(qz, x, n) - product(qx, z, n),
          product(qw, z, n) + product(qx, y, n) - product(qy, x, n),
      };
      for (std::size_t i = 0; i < 3; ++i) omega_[i][n + 1] = coupling_[i] * turning[i] / count;
      for (std::size_t i = 0; i < 4; ++i) q_[i][n + 1] = DoubleDouble{0.5} * moving[i] / count;
    }
    for (Series& series : omega_) series[0] = sum_of(series, h);
    for (Series& series : q_) series[0] = sum_of(series, h);
  }

  std::array<DoubleDouble, 3> coupling_;  // of omega_i' = coupling omega_j omega_k
  std::array<Series, 3> omega_;           // about now, [rad/s] and powers of s
  std::array<Series, 4> q_;
};

}  // namespace twincraft::test
