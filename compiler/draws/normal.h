// The standard normal distribution, by the arithmetic that every machine shares.
// Tested by tests/compiler/draws_test.cpp.
#pragma once

namespace twincraft::draws {

/// The part of a standard normal below `x`: algorithm 5666 of Hart and others, "Computer
/// approximations" (1968). Off by less than 1e-15.
double normal_cdf(double x);

/// Its inverse: AS 241 (PPND16) of Wichura, Applied Statistics 37 (1988). Relative errors are some
/// 1e-16. @pre 0 < p < 1
double normal_quantile(double p);

}  // namespace twincraft::draws
