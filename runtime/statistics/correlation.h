// Which inputs an output follows, by rank and by a linear model.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace twincraft::statistics {

struct RankCorrelation {
  std::size_t count = 0;     // pairs without a hole
  double coefficient = 0.0;  // -1 to 1
  // That independent inputs are as far from 0 or farther, by Student's t: good from ten pairs on,
  // and with few ties.
  double p_value = 1.0;
};
/// Spearman's: Pearson's coefficient of the ranks, where values that are equal share the mean of
/// theirs. Pairs with a NaN, a hole, are left out. Nothing: fewer than three pairs, or one side is
/// the same in all. @pre both are as long
std::optional<RankCorrelation> spearman(std::span<const double> x, std::span<const double> y);

struct RankDifference {
  // That a value of the first group is larger than one of the second, both taken at random; equal
  // ones count half. Twice as much, less 1, is the rank-biserial correlation.
  double larger = 0.5;
  // That groups of one distribution are as far from a half or farther: normal, with corrections for
  // ties and continuity, so good from about ten values in either group on.
  double p_value = 1.0;
};
/// Mann and Whitney's comparison of two groups. NaN, a hole, is left out. Nothing: a group is
/// empty, or all values are the same.
std::optional<RankDifference> rank_difference(std::span<const double> first,
                                              std::span<const double> second);

struct Regression {
  std::size_t count = 0;             // members without a hole
  std::vector<double> coefficients;  // standardised, one per input
  double r_squared = 0.0;            // share of the variance that the linear model explains
};
/// Least squares of the standardised output over the standardised inputs (Householder QR with
/// pivoting). An input that is the same in all members has the coefficient 0. Members with a NaN
/// are left out. Nothing: not more members than inputs and one, an output that is the same in all,
/// or inputs of which one follows from others: their coefficients are not unique.
/// @param inputs  a column each, as long as `output`
std::optional<Regression> standardised_regression(std::span<const std::span<const double>> inputs,
                                                  std::span<const double> output);

}  // namespace twincraft::statistics
