// See rounding.h.
#include "runtime/compare/rounding.h"

#include <Eigen/Cholesky>
#include <limits>

namespace twincraft {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kUnit = kRoundings * std::numeric_limits<double>::epsilon();

}  // namespace

MatrixXd mass_rounding(const RoundingTerms& terms) { return kUnit * terms.mass; }

// Scaled to a diagonal of ones, as a small body beside a large one makes M look near singular.
MatrixXd inverse_of(const MatrixXd& M) {
  const VectorXd scale = M.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = scale.asDiagonal() * M * scale.asDiagonal();
  const MatrixXd inverse = scaled.llt().solve(MatrixXd::Identity(M.rows(), M.cols()));
  return scale.asDiagonal() * inverse * scale.asDiagonal();
}

VectorXd acceleration_rounding(const RoundingTerms& terms, const MatrixXd& M,
                               const VectorXd& acceleration) {
  if (terms.force.size() == 0) return {};
  const VectorXd off = kUnit * (terms.mass * acceleration.cwiseAbs() + terms.force);
  return inverse_of(M).cwiseAbs() * off;
}

}  // namespace twincraft
