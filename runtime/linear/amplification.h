// What one step of a Runge-Kutta method does to a mode exp(s t): it multiplies the mode by R(h s),
// a polynomial of the tableau alone, where the exact solution multiplies it by exp(h s). From R
// follow the largest stable step and the error of a mode after many steps.
#pragma once

#include <complex>

#include "runtime/integrate/tableau.h"

namespace twincraft {

using Complex = std::complex<double>;

/// R(z) of the solution that is propagated, z = h s. Source: Hairer and Wanner, Solving Ordinary
/// Differential Equations II, section IV.2.
Complex amplification(const Tableau& tableau, Complex z);

/// The largest h |s| for which steps along the direction of `s` do not grow: |R| <= 1.001 all the
/// way from zero. @pre s is not zero and not in the right half plane
double stability_limit(const Tableau& tableau, Complex s);

/// How far a mode of amplitude 1 is off, at worst, within `duration` [s] of steps of `h` [s]: the
/// maximum of |R(h s)^n - exp(n h s)| over n. True growth (Re s > 0) is divided out.
double mode_error(const Tableau& tableau, Complex s, double h, double duration);

/// No less than mode_error(), and a hundredth of its cost. It is near while it is small.
double mode_error_bound(const Tableau& tableau, Complex s, double h, double duration);
/// The same of any mode that is no faster than `rate` [rad/s].
/// @pre R is the exponential cut at the order of the method: none with a step of its own
double fastest_mode_error_bound(const Tableau& tableau, double rate, double h, double duration);

/// The largest step [s] up to `h` whose mode_error() stays within `limit`.
double step_for_mode_error(const Tableau& tableau, Complex s, double h, double duration,
                           double limit);

}  // namespace twincraft
