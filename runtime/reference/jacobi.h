// Jacobi's elliptic functions in extended precision, with small relative errors of sn, cn and dn
// each: near k = 1, cn and dn fall to 1 - k^2 and below, where an absolute error is worth nothing.
#pragma once

namespace twincraft {

struct JacobiFunctions {
  long double sn, cn, dn;
};

/// @param u   argument, in [-K, K]
/// @param to_quarter  K - |u|, formed without cancellation
/// @param complement  k' = sqrt(1 - k^2), in (0, 1]
JacobiFunctions jacobi(long double u, long double to_quarter, long double complement);

}  // namespace twincraft
