// See arithmetic.h. Series on an interval around zero, and what brings an argument there.
#include "compiler/draws/arithmetic.h"

#include <cmath>
#include <limits>

namespace twincraft::draws {
namespace {

// The natural logarithm of two: 32 bits of it, so that small multiples are exact, and the rest.
constexpr double kLn2 = 0x1.62e42ffp-1, kLn2Rest = -0x1.718432a1b0e26p-35;
// A quarter turn, in the same way [rad].
constexpr double kQuarter = 0x1.921fb544p+0, kQuarterRest = 0x1.0b4611a626331p-34;
constexpr double kSqrtHalf = 0.70710678118654752;
constexpr double kLargestExponent = 700.0;

/// Sum of x^k / k! with every second term, of alternating sign, from `first` on. |x| <= pi/4.
double alternating(double x, int first) {
  double term = first == 0 ? 1.0 : x;
  double sum = 0.0;
  // Smallest terms first: the sum is rounded once where it counts.
  double terms[11];
  for (int i = 0; i < 11; ++i) {
    terms[i] = term;
    const double k = first + 2 * i;
    term *= -x * x / ((k + 1.0) * (k + 2.0));
  }
  for (int i = 10; i >= 0; --i) sum += terms[i];
  return sum;
}

}  // namespace

double natural_logarithm(double x) {
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);
  if (mantissa < kSqrtHalf) {
    mantissa *= 2.0;
    exponent -= 1;
  }
  // log m = 2 artanh s = 2 (s + s^3/3 + ..) with |s| < 0.172
  const double s = (mantissa - 1.0) / (mantissa + 1.0);
  double sum = 0.0;
  for (int k = 25; k >= 3; k -= 2) sum = (sum + 1.0 / k) * s * s;
  return exponent * kLn2 + (2.0 * (s + s * sum) + exponent * kLn2Rest);
}

double exponential(double x) {
  if (x < -kLargestExponent) return 0.0;
  if (x > kLargestExponent) return std::numeric_limits<double>::infinity();
  const double power = std::floor(x / (kLn2 + kLn2Rest) + 0.5);
  const double rest = (x - power * kLn2) - power * kLn2Rest;
  double sum = 0.0;
  for (int k = 14; k >= 1; --k) sum = (1.0 + sum) * rest / k;
  return std::ldexp(1.0 + sum, static_cast<int>(power));
}

SineCosine sine_cosine(double angle) {
  const double quarters = std::floor(angle / (kQuarter + kQuarterRest) + 0.5);
  const double rest = (angle - quarters * kQuarter) - quarters * kQuarterRest;
  const double sine = alternating(rest, 1), cosine = alternating(rest, 0);
  switch (static_cast<long long>(quarters) & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

}  // namespace twincraft::draws
