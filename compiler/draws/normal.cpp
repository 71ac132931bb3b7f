// See normal.h.
#include "compiler/draws/normal.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "compiler/draws/arithmetic.h"

namespace twincraft::draws {
namespace {

/// Highest power first.
template <std::size_t n>
double polynomial(const std::array<double, n>& coefficients, double x) {
  double value = 0.0;
  for (const double c : coefficients) value = value * x + c;
  return value;
}

constexpr std::array kHartAbove{3.52624965998911e-02, 0.700383064443688, 6.37396220353165,
                                33.912866078383,      112.079291497871,  221.213596169931,
                                220.206867912376};
constexpr std::array kHartBelow{8.83883476483184e-02, 1.75566716318264, 16.064177579207,
                                86.7807322029461,     296.564248779674, 637.333633378831,
                                793.826512519948,     440.413735824752};
constexpr double kFraction = 7.07106781186547;  // from here on by a continued fraction
constexpr double kNothing = 38.0;               // below the smallest normal double
constexpr double kSqrtTwoPi = 2.5066282746310002;

/// The part above x >= 0.
double upper_tail(double x) {
  if (x > kNothing) return 0.0;
  const double density = exponential(-x * x / 2.0);
  if (x < kFraction) return density * polynomial(kHartAbove, x) / polynomial(kHartBelow, x);
  double depth = x + 0.65;
  for (int k = 4; k >= 1; --k) depth = x + k / depth;
  return density / (depth * kSqrtTwoPi);
}

constexpr std::array kCentreAbove{2.5090809287301226727e+3, 3.3430575583588128105e+4,
                                  6.7265770927008700853e+4, 4.5921953931549871457e+4,
                                  1.3731693765509461125e+4, 1.9715909503065514427e+3,
                                  1.3314166789178437745e+2, 3.3871328727963666080e+0};
constexpr std::array kCentreBelow{5.2264952788528545610e+3, 2.8729085735721942674e+4,
                                  3.9307895800092710610e+4, 2.1213794301586595867e+4,
                                  5.3941960214247511077e+3, 6.8718700749205790830e+2,
                                  4.2313330701600911252e+1, 1.0};
constexpr std::array kNearAbove{7.7454501427834140764e-4, 2.2723844989269184187e-2,
                                2.4178072517745061177e-1, 1.2704582524523684191e+0,
                                3.6478483247632045605e+0, 5.7694972214606914055e+0,
                                4.6303378461565452959e+0, 1.4234371107496835773e+0};
constexpr std::array kNearBelow{1.0507500716444168432e-9, 5.4759380849953449460e-4,
                                1.5198666563616457197e-2, 1.4810397642748007459e-1,
                                6.8976733498510000455e-1, 1.6763848301838038494e+0,
                                2.0531916266377588019e+0, 1.0};
constexpr std::array kFarAbove{2.0103343992922881077e-7, 2.7115555687434875781e-5,
                               1.2426609473880784386e-3, 2.6532189526576123093e-2,
                               2.9656057182850489123e-1, 1.7848265399172913358e+0,
                               5.4637849111641143699e+0, 6.6579046435011037772e+0};
constexpr std::array kFarBelow{2.0442631033899397376e-15, 1.4215117583164458887e-7,
                               1.8463183175100546818e-5,  7.8686913114561325910e-4,
                               1.4875361290850615025e-2,  1.3692988092273580531e-1,
                               5.9983220655588793769e-1,  1.0};

}  // namespace

double normal_cdf(double x) { return x > 0.0 ? 1.0 - upper_tail(x) : upper_tail(-x); }

double normal_quantile(double p) {
  const double q = p - 0.5;
  if (std::abs(q) <= 0.425) {
    const double r = 0.180625 - q * q;
    return q * polynomial(kCentreAbove, r) / polynomial(kCentreBelow, r);
  }
  const double tail = q < 0.0 ? p : 1.0 - p;
  const double r = std::sqrt(-natural_logarithm(tail));
  const double x = r <= 5.0 ? polynomial(kNearAbove, r - 1.6) / polynomial(kNearBelow, r - 1.6)
                            : polynomial(kFarAbove, r - 5.0) / polynomial(kFarBelow, r - 5.0);
  return q < 0.0 ? -x : x;
}

}  // namespace twincraft::draws
