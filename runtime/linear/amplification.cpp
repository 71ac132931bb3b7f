#include "runtime/linear/amplification.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace twincraft {
namespace {

// An amplitude that grows by a thousandth a step is not stable any more; less is rounding of the
// scan, or a method's slow growth, which mode_error() sees.
constexpr double kStable = 1.001;

constexpr int kInstants = 60;        // of a run at which a mode is looked at
constexpr double kHopeless = 1.0e6;  // an error beyond this has no finer shades
constexpr double kFarthest = 8.0;    // no method here is stable at h |s| = 8
constexpr double kScanStep = 0.05;   // of h |s|

/// exp(n log R), limited so that it never overflows.
Complex power(Complex log_R, double n) {
  const double growth = std::min(n * log_R.real(), std::log(kHopeless));
  return std::polar(std::exp(growth), n * log_R.imag());
}

double error_after(Complex log_R, Complex z, double n) {
  const double true_growth = std::max(0.0, n * z.real());
  const Complex found = power({log_R.real() - true_growth / n, log_R.imag()}, n);
  const Complex exact = std::polar(std::exp(n * z.real() - true_growth), n * z.imag());
  return std::abs(found - exact);
}

/// Of |a^n - b^n|, which is |a - b| times n products of n - 1 factors.
/// @param difference  |a - b|
/// @param largest     of |a| and |b|
double bound_after(double difference, double largest, double steps) {
  steps = std::max(1.0, std::floor(steps));
  return difference * (largest < 1.0 ? std::min(steps, 1.0 / (1.0 - largest))
                                     : steps * std::pow(largest, steps - 1.0));
}

}  // namespace

Complex amplification(const Tableau& tableau, Complex z) {
  std::array<Complex, Tableau::kMaxStages> stage{};
  Complex sum = 1.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(tableau.stages); ++i) {
    stage[i] = 1.0;
    for (std::size_t j = 0; j < i; ++j) stage[i] += z * tableau.a[i][j] * stage[j];
    sum += z * tableau.b[i] * stage[i];
  }
  return sum;
}

double stability_limit(const Tableau& tableau, Complex s) {
  const Complex direction = s / std::abs(s);
  const auto is_stable = [&](double y) {
    return std::abs(amplification(tableau, y * direction)) <= kStable;
  };
  double stable = 0.0;
  while (stable < kFarthest && is_stable(stable + kScanStep)) stable += kScanStep;
  double unstable = stable + kScanStep;
  while (unstable - stable > 1.0e-9) {
    const double middle = 0.5 * (stable + unstable);
    (is_stable(middle) ? stable : unstable) = middle;
  }
  return stable;
}

double mode_error(const Tableau& tableau, Complex s, double h, double duration) {
  const Complex z = h * s;
  const Complex R = amplification(tableau, z);
  if (std::abs(R) > kHopeless || !std::isfinite(std::abs(R))) return kHopeless;
  const Complex log_R = std::abs(R) == 0.0 ? Complex(-700.0, 0.0) : std::log(R);
  const double steps = std::max(1.0, std::floor(duration / h));
  double worst = 0.0;
  double last = 0.0;
  for (int i = 0; i < kInstants; ++i) {
    const double n = std::round(std::pow(steps, static_cast<double>(i) / (kInstants - 1)));
    if (n == last) continue;
    last = n;
    worst = std::max(worst, error_after(log_R, z, n));
  }
  return std::min(worst, kHopeless);
}

double mode_error_bound(const Tableau& tableau, Complex s, double h, double duration) {
  const Complex z = h * s;
  const double true_growth = std::exp(std::max(0.0, z.real()));
  const Complex found = amplification(tableau, z) / true_growth;
  const Complex exact = std::polar(std::exp(std::min(0.0, z.real())), z.imag());
  return bound_after(std::abs(found - exact), std::max(std::abs(found), std::abs(exact)),
                     duration / h);
}

double fastest_mode_error_bound(const Tableau& tableau, double rate, double h, double duration) {
  const double y = h * rate;
  const int next = tableau.order + 1;
  const double rest = std::pow(y, next) / std::tgamma(next + 1.0) * std::exp(y);
  return bound_after(rest, 1.0 + rest, duration / h);
}

double step_for_mode_error(const Tableau& tableau, Complex s, double h, double duration,
                           double limit) {
  if (mode_error(tableau, s, h, duration) <= limit) return h;
  double fine = 1.0e-8 * h;
  double coarse = h;
  for (int i = 0; i < 40; ++i) {
    const double middle = std::sqrt(fine * coarse);
    (mode_error(tableau, s, middle, duration) <= limit ? fine : coarse) = middle;
  }
  return fine;
}

}  // namespace twincraft
