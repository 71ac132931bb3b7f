// Claims about the factors that the kernel solves 3x3 systems by: as exact as an elimination can
// be, whatever the condition.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "runtime/scalar/linear.h"

namespace twincraft {
namespace {

using portable::Ldl, portable::Sym, portable::Vec;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Symmetric, with the given eigenvalues, in axes drawn at random.
Matrix3d turned(const Vector3d& eigenvalues, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
  const Matrix3d axes = q.normalized().toRotationMatrix();
  const Matrix3d m = axes * eigenvalues.asDiagonal() * axes.transpose();
  return 0.5 * (m + m.transpose());
}

Sym<double> sym(const Matrix3d& m) {
  return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
}

/// Condition of the matrix, and which of its eigenvalues are small: one or two.
class LdlOf : public testing::TestWithParam<std::tuple<double, int>> {};

INSTANTIATE_TEST_SUITE_P(Ldl, LdlOf,
                         testing::Combine(testing::Values(1.0, 1e3, 1e6, 1e9),
                                          testing::Values(1, 2)));

TEST_P(LdlOf, SolvesBackwardStably) {
  const auto [condition, small] = GetParam();
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d eigenvalues(1.0, small == 1 ? 0.7 : 1.3 / condition, 1.0 / condition);
    const Matrix3d m = 600.0 * turned(eigenvalues, random);
    const Vector3d b(normal(random), normal(random), normal(random));
    const Vector3d x = eigen(Ldl<double>(sym(m)).solve(portable::vec(b)));
    // A dozen roundings of numbers no larger than |m| |x|.
    EXPECT_LE((m * x - b).norm(), 12.0 * kEpsilon * m.norm() * x.norm()) << m;
  }
}

TEST_P(LdlOf, HasAnInverseAsGoodAsTheConditionAllows) {
  const auto [condition, small] = GetParam();
  std::mt19937 random(8);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d eigenvalues(1.0, small == 1 ? 0.7 : 1.3 / condition, 1.0 / condition);
    const Matrix3d m = 600.0 * turned(eigenvalues, random);
    const Matrix3d inverse = eigen(Ldl<double>(sym(m)).inverse());
    EXPECT_LE((m * inverse - Matrix3d::Identity()).norm(), 24.0 * kEpsilon * condition) << m;
  }
}

}  // namespace
}  // namespace twincraft
