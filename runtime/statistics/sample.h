// What a set of numbers looks like: moments, percentiles with bounds, tolerance bounds, and the
// empirical distribution. Pure functions of doubles; none of these knows a vehicle.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace twincraft::statistics {

/// Those that are numbers, in rising order: NaN, a hole, is left out.
std::vector<double> sorted(std::span<const double> values);

struct Moments {
  std::size_t count = 0;  // of what is no hole
  // NaN where they do not exist: of nothing; the last two of fewer than two or three values, the
  // skewness also where all values are the same.
  double mean = 0.0;
  double deviation = 0.0;  // standard, by count - 1
  double skewness = 0.0;   // adjusted Fisher-Pearson, as spreadsheets have it
};
Moments moments(std::span<const double> values);

/// Of rising values: straight between order statistics, the p-quantile at place p (n - 1) (type 7
/// of Hyndman and Fan, the default of NumPy and R). NaN of nothing. @pre 0 <= p <= 1
double quantile(std::span<const double> rising, double p);

/// Bounds of a quantile of the distribution that the values are drawn from.
struct Bounds {
  std::optional<double> lower, upper;  // nothing: too few values for a bound
};
/// Order statistics between which the p-quantile lies with at least this confidence, half of the
/// rest on either side. It takes no assumption on the distribution. @pre 0 < p, confidence < 1
Bounds quantile_bounds(std::span<const double> rising, double p, double confidence);

/// How many values it takes until, with this confidence, the `rank`-th largest is above a share
/// `coverage` of the distribution (Wilks; one-sided): 59 for 95 % with 95 %. @pre 0 < both < 1
std::size_t wilks_number(double coverage, double confidence, std::size_t rank = 1);

struct ToleranceBound {
  double value = 0.0;
  std::size_t rank = 1;  // it is the `rank`-th largest
};
/// The smallest of the values that is above a share `coverage` of the distribution with this
/// confidence (Wilks; one-sided). Nothing: there are fewer than wilks_number() values.
std::optional<ToleranceBound> tolerance_bound(std::span<const double> rising, double coverage,
                                              double confidence);

struct Step {
  double value = 0.0;
  double share = 0.0;  // of the values that are no larger
};
/// The empirical distribution function of rising values: a step per distinct value, or at most
/// `most` of them. A curve through these is off by no more than 1 / (most - 1). @pre most >= 2
std::vector<Step> distribution(std::span<const double> rising, std::size_t most);

}  // namespace twincraft::statistics
