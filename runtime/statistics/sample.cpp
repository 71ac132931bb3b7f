#include "runtime/statistics/sample.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <limits>

namespace twincraft::statistics {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// That at most `successes` of `trials` succeed.
double at_most(std::size_t successes, std::size_t trials, double probability) {
  if (successes >= trials) return 1.0;
  return boost::math::cdf(
      boost::math::binomial_distribution<double>(static_cast<double>(trials), probability),
      static_cast<double>(successes));
}

/// The first number of [first, end) of which `holds` is true, as it is of all that follow; `end`:
/// of none.
template <class Predicate>
std::size_t first_of(std::size_t first, std::size_t end, Predicate holds) {
  while (first < end) {
    const std::size_t middle = first + (end - first) / 2;
    if (holds(middle))
      end = middle;
    else
      first = middle + 1;
  }
  return first;
}

/// That the `rank`-th largest of `count` values is above the share `coverage`: at least `rank` of
/// them lie in what is left.
double confidence_of(std::size_t rank, std::size_t count, double coverage) {
  return 1.0 - at_most(rank - 1, count, 1.0 - coverage);
}

/// How many values are no larger than that at `place`.
std::size_t step_end(std::span<const double> rising, std::size_t place) {
  std::size_t end = place + 1;
  while (end < rising.size() && rising[end] == rising[place]) ++end;
  return end;
}

}  // namespace

std::vector<double> sorted(std::span<const double> values) {
  std::vector<double> rising;
  std::ranges::copy_if(values, std::back_inserter(rising),
                       [](double value) { return !std::isnan(value); });
  std::ranges::sort(rising);
  return rising;
}

Moments moments(std::span<const double> values) {
  Moments found;
  double sum = 0.0;
  for (const double value : values)
    if (!std::isnan(value)) {
      ++found.count;
      sum += value;
    }
  const auto n = static_cast<double>(found.count);
  found.mean = found.count > 0 ? sum / n : kNone;
  double second = 0.0, third = 0.0;  // sums of powers about the mean
  for (const double value : values)
    if (!std::isnan(value)) {
      const double off = value - found.mean;
      second += off * off;
      third += off * off * off;
    }
  found.deviation = found.count > 1 ? std::sqrt(second / (n - 1.0)) : kNone;
  found.skewness = found.count > 2 && second > 0.0 ? std::sqrt(n * (n - 1.0)) / (n - 2.0) *
                                                         (third / n) / std::pow(second / n, 1.5)
                                                   : kNone;
  return found;
}

double quantile(std::span<const double> rising, double p) {
  if (rising.empty()) return kNone;
  const double place = p * static_cast<double>(rising.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), rising.size() - 1);
  const std::size_t above = std::min(below + 1, rising.size() - 1);
  return std::lerp(rising[below], rising[above], place - static_cast<double>(below));
}

Bounds quantile_bounds(std::span<const double> rising, double p, double confidence) {
  const std::size_t n = rising.size();
  const double half = 0.5 * (1.0 - confidence);
  // How many values lie below the quantile is binomial. The k-th smallest is above it when fewer
  // than k do, and below it when at least k do.
  const std::size_t above =
      first_of(0, n, [&](std::size_t k) { return at_most(k, n, p) >= 1.0 - half; });
  const std::size_t beyond = first_of(0, n, [&](std::size_t k) { return at_most(k, n, p) > half; });
  Bounds bounds;
  if (above < n) bounds.upper = rising[above];
  if (beyond > 0) bounds.lower = rising[beyond - 1];
  return bounds;
}

std::size_t wilks_number(double coverage, double confidence, std::size_t rank) {
  const auto is_enough = [&](std::size_t count) {
    return confidence_of(rank, count, coverage) >= confidence;
  };
  std::size_t end = rank;
  while (!is_enough(end)) end *= 2;
  return first_of(rank, end, is_enough);
}

std::optional<ToleranceBound> tolerance_bound(std::span<const double> rising, double coverage,
                                              double confidence) {
  const std::size_t n = rising.size();
  const std::size_t too_far = first_of(
      1, n + 1, [&](std::size_t rank) { return confidence_of(rank, n, coverage) < confidence; });
  if (too_far == 1) return std::nullopt;
  return ToleranceBound{rising[n - (too_far - 1)], too_far - 1};
}

std::vector<Step> distribution(std::span<const double> rising, std::size_t most) {
  const std::size_t n = rising.size();
  std::vector<std::size_t> ends;  // of the steps
  for (std::size_t i = 0; i < n; i = ends.back()) ends.push_back(step_end(rising, i));
  // Where there are too many, heights are cut into stretches. The last step of each is kept, and
  // the first of all.
  const auto stretch = [&](std::size_t end) { return (end * (most - 1) + n - 1) / n; };
  std::vector<Step> steps;
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (ends.size() <= most || i == 0 || i + 1 == ends.size() ||
        stretch(ends[i]) != stretch(ends[i + 1]))
      steps.push_back({rising[ends[i] - 1], static_cast<double>(ends[i]) / static_cast<double>(n)});
  return steps;
}

}  // namespace twincraft::statistics
