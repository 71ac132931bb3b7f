// Descending Landen transformation (Abramowitz and Stegun, 16.12) of cs = cn/sn and dn. Written in
// k' and cs all terms are positive, so nothing cancels at any modulus. The upper half of the
// quarter period follows from the lower by u -> K - u.
#include "runtime/reference/jacobi.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace twincraft {
namespace {

using Real = long double;

struct Ratio {
  Real cs, dn;
};

/// @pre u > 0, not close to K
Ratio ratio(Real u, Real complement) {
  const Real modulus = (1.0L - complement) / (1.0L + complement);  // of the next functions
  const Real v = u / (1.0L + modulus);
  const bool is_circular = modulus * modulus < std::numeric_limits<Real>::epsilon();
  const Ratio next = is_circular ? Ratio{1.0L / std::tan(v), 1.0L}
                                 : ratio(v, 2.0L * std::sqrt(complement) / (1.0L + complement));
  const Real square = next.cs * next.cs;
  return {next.cs * next.dn / (1.0L + modulus),
          ((1.0L - modulus) + square) / ((1.0L + modulus) + square)};
}

/// @pre as ratio(), or u = 0
JacobiFunctions lower_half(Real u, Real complement) {
  if (u == 0.0L) return {0.0L, 1.0L, 1.0L};
  const auto [cs, dn] = ratio(u, complement);
  const Real sn = 1.0L / std::sqrt(1.0L + cs * cs);
  return {sn, cs * sn, dn};
}

}  // namespace

JacobiFunctions jacobi(Real u, Real to_quarter, Real complement) {
  const Real size = std::abs(u);
  const Real rest = std::max(to_quarter, 0.0L);  // its rounding may have passed K
  JacobiFunctions at = lower_half(std::min(size, rest), complement);
  if (rest < size) at = {at.cn / at.dn, complement * at.sn / at.dn, complement / at.dn};
  at.sn = std::copysign(at.sn, u);
  return at;
}

}  // namespace twincraft
