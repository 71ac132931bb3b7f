// See copula.h.
#include "compiler/draws/copula.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "compiler/draws/normal.h"

namespace twincraft::draws {
namespace {

constexpr double kLeast = 0x1p-53;

Eigen::Index row_of(std::size_t column, std::vector<std::size_t>& columns) {
  const auto found = std::ranges::find(columns, column);
  const auto row = found - columns.begin();
  if (found == columns.end()) columns.push_back(column);
  return row;
}

}  // namespace

std::optional<Copula> Copula::of(const std::vector<Correlation>& correlations) {
  Copula copula;
  for (const Correlation& each : correlations) {
    row_of(each.first, copula.columns_);
    row_of(each.second, copula.columns_);
  }
  const auto size = static_cast<Eigen::Index>(copula.columns_.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(size, size);
  for (const Correlation& each : correlations) {
    const Eigen::Index i = row_of(each.first, copula.columns_);
    const Eigen::Index j = row_of(each.second, copula.columns_);
    matrix(i, j) = matrix(j, i) = each.rho;
  }
  const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix);
  if (cholesky.info() != Eigen::Success) return std::nullopt;
  copula.factor_ = cholesky.matrixL();
  return copula;
}

void Copula::apply(std::vector<double>& uniforms) const {
  Eigen::VectorXd normals(factor_.rows());
  for (Eigen::Index i = 0; i < normals.size(); ++i)
    normals[i] = normal_quantile(uniforms[columns_[static_cast<std::size_t>(i)]]);
  for (Eigen::Index i = 1; i < normals.size(); ++i) {
    double sum = 0.0;
    for (Eigen::Index j = 0; j <= i; ++j) sum += factor_(i, j) * normals[j];
    uniforms[columns_[static_cast<std::size_t>(i)]] =
        std::clamp(normal_cdf(sum), kLeast, 1.0 - kLeast);
  }
}

}  // namespace twincraft::draws
