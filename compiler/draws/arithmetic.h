// Elementary functions from sums, products, quotients and powers of two alone. Those of a C library
// may differ in the last digit from one processor to the next; what is drawn may not. Within four
// units in the last place. Tested by tests/compiler/draws_test.cpp.
#pragma once

namespace twincraft::draws {

/// @pre x > 0 and normal
double natural_logarithm(double x);
/// 0 below exp(-700) and infinity above exp(700).
double exponential(double x);

struct SineCosine {
  double sine = 0.0, cosine = 1.0;
};
/// @param angle  [rad] of a few turns at most
SineCosine sine_cosine(double angle);

}  // namespace twincraft::draws
