// What everything that looks at samples has in common: degrees, the angle between two attitudes, a
// running maximum, and when two times are one.
#pragma once

#include <algorithm>
#include <cmath>

#include "compiler/ir/angle.h"

namespace twincraft {

/// A running maximum that a NaN wins for good: a comparison that cannot be made never passes.
/// @param at  [s] when the maximum first occurred
inline void keep_larger(double value, double time, double& maximum, double& at) {
  // Once NaN, `maximum` compares false with everything and stays; a NaN value is taken at once.
  if (std::isnan(maximum) || value <= maximum) return;
  maximum = value;
  at = time;
}

/// How far two times that are reached by different sums, such as index * step at two steps, may be
/// apart [s].
inline double time_tolerance(double time) { return 1.0e-12 * std::max(1.0, std::abs(time)); }
inline bool same_time(double a, double b) { return std::abs(a - b) <= time_tolerance(b); }

}  // namespace twincraft
