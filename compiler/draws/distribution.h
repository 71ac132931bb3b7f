// From a uniform number to a drawn one, by the inverse of the distribution function: one number
// each, rising with the uniform one, so that strata and sequences keep their structure.
// Tested by tests/compiler/draws_test.cpp.
#pragma once

#include <optional>
#include <variant>
#include <vector>

namespace twincraft::draws {

struct Normal {
  double mean = 0.0, sigma = 0.0;
  std::optional<double> truncate = {};  // at so many sigmas on both sides; sigma is that before
};
struct Uniform {
  double low = 0.0, high = 0.0;
};
/// The logarithm of value / mean is normal. Mean and standard deviation are those of the value.
struct Lognormal {
  double mean = 0.0, sigma = 0.0;  // mean is not 0; a negative one makes negative values
};
struct Triangular {
  double low = 0.0, high = 0.0, mode = 0.0;
};
/// Each as often as the others.
struct Choice {
  std::vector<double> values;
};

using Distribution = std::variant<Normal, Uniform, Lognormal, Triangular, Choice>;

/// @pre 0 < uniform < 1
double value_of(const Distribution& distribution, double uniform);

/// The factor of a lognormal distribution of mean 1.
double lognormal_factor(double sigma, double uniform);

}  // namespace twincraft::draws
