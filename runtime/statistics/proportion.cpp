#include "runtime/statistics/proportion.h"

#include <boost/math/distributions/beta.hpp>

namespace twincraft::statistics {

Interval clopper_pearson(std::size_t successes, std::size_t trials, double confidence) {
  const double half = 0.5 * (1.0 - confidence);
  const auto yes = static_cast<double>(successes), no = static_cast<double>(trials - successes);
  const auto beta = [](double a, double b) { return boost::math::beta_distribution<double>(a, b); };
  Interval interval;
  if (yes > 0.0) interval.lower = quantile(beta(yes, no + 1.0), half);
  if (no > 0.0) interval.upper = quantile(complement(beta(yes + 1.0, no), half));
  return interval;
}

}  // namespace twincraft::statistics
