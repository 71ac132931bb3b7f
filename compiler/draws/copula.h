// Columns that depend on one another: a Gaussian copula. What is correlated are the standard normal
// numbers behind the columns; each column keeps its own distribution. Tested by
// tests/compiler/draws_test.cpp.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace twincraft::draws {

struct Correlation {
  std::size_t first = 0, second = 0;  // columns
  double rho = 0.0;                   // between -1 and 1
};

class Copula {
 public:
  /// Nothing when no numbers can be correlated so: the matrix is not positive definite.
  /// @pre each pair is given once
  static std::optional<Copula> of(const std::vector<Correlation>& correlations);

  /// @param uniforms  of all columns, independent in (0, 1); become dependent
  void apply(std::vector<double>& uniforms) const;

 private:
  std::vector<std::size_t> columns_;  // those that are correlated
  Eigen::MatrixXd factor_;            // lower triangle, of Cholesky
};

}  // namespace twincraft::draws
