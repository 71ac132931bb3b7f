#include "runtime/statistics/correlation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

namespace twincraft::statistics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// From 1 on; equal values share the mean of their ranks.
VectorXd ranks_of(const VectorXd& values) {
  std::vector<Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::sort(order, {}, [&](Index i) { return values[i]; });
  VectorXd ranks(values.size());
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    const double rank = 0.5 * static_cast<double>(first + 1 + end);
    for (std::size_t i = first; i < end; ++i) ranks[order[i]] = rank;
  }
  return ranks;
}

/// Of mean 0 and length 1; zeros where all are the same.
VectorXd standardised(const VectorXd& values) {
  if (values.size() == 0 || values.minCoeff() == values.maxCoeff())
    return VectorXd::Zero(values.size());
  return (values.array() - values.mean()).matrix().normalized();
}

/// Of a coefficient that is 0 for independent inputs: two-sided.
double p_value_of(double coefficient, std::size_t count) {
  const double rest = 1.0 - coefficient * coefficient;
  if (rest <= 0.0) return 0.0;
  const double freedom = static_cast<double>(count) - 2.0;
  const double t = std::abs(coefficient) * std::sqrt(freedom / rest);
  return 2.0 * cdf(complement(boost::math::students_t_distribution<double>(freedom), t));
}

std::vector<double> whole(std::span<const double> values) {
  std::vector<double> numbers;
  std::ranges::remove_copy_if(values, std::back_inserter(numbers),
                              [](double value) { return std::isnan(value); });
  return numbers;
}

/// The rows of some columns that have no hole, as a matrix.
MatrixXd whole_rows(std::span<const std::span<const double>> columns) {
  std::vector<std::size_t> whole;
  for (std::size_t row = 0; row < columns.front().size(); ++row)
    if (std::ranges::none_of(columns, [row](const auto& one) { return std::isnan(one[row]); }))
      whole.push_back(row);
  MatrixXd rows(static_cast<Index>(whole.size()), static_cast<Index>(columns.size()));
  for (Index j = 0; j < rows.cols(); ++j)
    for (Index i = 0; i < rows.rows(); ++i)
      rows(i, j) = columns[static_cast<std::size_t>(j)][whole[static_cast<std::size_t>(i)]];
  return rows;
}

}  // namespace

std::optional<RankCorrelation> spearman(std::span<const double> x, std::span<const double> y) {
  const std::array columns{x, y};
  const MatrixXd rows = whole_rows(columns);
  if (rows.rows() < 3) return std::nullopt;
  const VectorXd a = standardised(ranks_of(rows.col(0))), b = standardised(ranks_of(rows.col(1)));
  if (a.isZero(0.0) || b.isZero(0.0)) return std::nullopt;
  const double coefficient = std::clamp(a.dot(b), -1.0, 1.0);
  const auto count = static_cast<std::size_t>(rows.rows());
  return RankCorrelation{count, coefficient, p_value_of(coefficient, count)};
}

std::optional<RankDifference> rank_difference(std::span<const double> first,
                                              std::span<const double> second) {
  std::vector<double> values = whole(first);
  const auto of_first = static_cast<Index>(values.size());
  const std::vector<double> others = whole(second);
  values.insert(values.end(), others.begin(), others.end());
  const auto all = static_cast<Index>(values.size());
  if (of_first == 0 || of_first == all) return std::nullopt;
  const VectorXd ranks = ranks_of(VectorXd::Map(values.data(), all));
  const auto n = static_cast<double>(all), n1 = static_cast<double>(of_first), n2 = n - n1;
  // The spread of ranks that ties leave: n (n^2 - 1) / 12 without any.
  const double spread = (ranks.array() - 0.5 * (n + 1.0)).square().sum();
  if (!(spread > 0.0)) return std::nullopt;
  const double pairs = n1 * n2;
  const double u = ranks.head(of_first).sum() - 0.5 * n1 * (n1 + 1.0);
  const double deviation = std::sqrt(pairs * spread / (n * (n - 1.0)));
  const double z = std::max(0.0, std::abs(u - 0.5 * pairs) - 0.5) / deviation;
  return RankDifference{u / pairs, std::erfc(z / std::numbers::sqrt2)};
}

std::optional<Regression> standardised_regression(std::span<const std::span<const double>> inputs,
                                                  std::span<const double> output) {
  std::vector<std::span<const double>> columns(inputs.begin(), inputs.end());
  columns.push_back(output);
  const MatrixXd rows = whole_rows(columns);
  const auto width = static_cast<Index>(inputs.size());
  if (rows.rows() <= width + 1) return std::nullopt;
  const VectorXd y = standardised(rows.col(width));
  if (y.isZero(0.0)) return std::nullopt;

  std::vector<Index> varied;
  MatrixXd x(rows.rows(), width);
  for (Index j = 0; j < width; ++j) {
    x.col(static_cast<Index>(varied.size())) = standardised(rows.col(j));
    if (!x.col(static_cast<Index>(varied.size())).isZero(0.0)) varied.push_back(j);
  }
  Regression found{static_cast<std::size_t>(rows.rows()), std::vector<double>(inputs.size(), 0.0)};
  if (varied.empty()) return found;
  x.conservativeResize(Eigen::NoChange, static_cast<Index>(varied.size()));
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(x);
  if (qr.rank() < x.cols()) return std::nullopt;
  const VectorXd coefficients = qr.solve(y);
  for (Index j = 0; j < coefficients.size(); ++j)
    found.coefficients[static_cast<std::size_t>(varied[static_cast<std::size_t>(j)])] =
        coefficients[j];
  found.r_squared = std::clamp(1.0 - (y - x * coefficients).squaredNorm(), 0.0, 1.0);
  return found;
}

}  // namespace twincraft::statistics
