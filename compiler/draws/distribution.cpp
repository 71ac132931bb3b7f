// See distribution.h.
#include "compiler/draws/distribution.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "compiler/draws/arithmetic.h"
#include "compiler/draws/normal.h"

namespace twincraft::draws {
namespace {

double value(const Normal& normal, double uniform) {
  double p = uniform;
  if (normal.truncate) {
    const double below = normal_cdf(-*normal.truncate);
    p = below + uniform * (1.0 - 2.0 * below);
  }
  return normal.mean + normal.sigma * normal_quantile(p);
}

double value(const Uniform& range, double uniform) {
  return range.low + uniform * (range.high - range.low);
}

double value(const Lognormal& lognormal, double uniform) {
  return lognormal.mean * lognormal_factor(lognormal.sigma / lognormal.mean, uniform);
}

double value(const Triangular& triangle, double uniform) {
  const double width = triangle.high - triangle.low;
  const double rise = triangle.mode - triangle.low;
  if (uniform * width <= rise) return triangle.low + std::sqrt(uniform * width * rise);
  return triangle.high - std::sqrt((1.0 - uniform) * width * (triangle.high - triangle.mode));
}

double value(const Choice& choice, double uniform) {
  const std::size_t count = choice.values.size();
  const auto index = static_cast<std::size_t>(uniform * static_cast<double>(count));
  return choice.values[std::min(index, count - 1)];
}

}  // namespace

double value_of(const Distribution& distribution, double uniform) {
  return std::visit([uniform](const auto& one) { return value(one, uniform); }, distribution);
}

double lognormal_factor(double sigma, double uniform) {
  const double variance = natural_logarithm(1.0 + sigma * sigma);  // of the factor's logarithm
  return exponential(std::sqrt(variance) * normal_quantile(uniform) - variance / 2.0);
}

}  // namespace twincraft::draws
