// See mass.h. Tested by tests/compiler/ir_test.cpp.
#include "compiler/ir/mass.h"

#include <Eigen/Eigenvalues>

namespace twincraft {

Matrix3d tilde(const Vector3d& v) {
  Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

Matrix3d parallel_axis(const Matrix3d& I_PntC, double mass, const Vector3d& r) {
  return I_PntC + mass * (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
}

MassProperties operator+(const MassProperties& a, const MassProperties& b) {
  MassProperties sum;
  sum.mass = a.mass + b.mass;
  sum.I_PntC_L = a.I_PntC_L + b.I_PntC_L;
  if (b.mass == 0.0) {
    sum.r_CL_L = a.r_CL_L;
  } else if (a.mass == 0.0) {
    sum.r_CL_L = b.r_CL_L;
  } else {
    sum.r_CL_L = (a.mass * a.r_CL_L + b.mass * b.r_CL_L) / sum.mass;
    // Two masses about their common centre act as the reduced mass at their distance.
    sum.I_PntC_L =
        parallel_axis(sum.I_PntC_L, a.mass * b.mass / sum.mass, (a.r_CL_L - b.r_CL_L).eval());
  }
  return sum;
}

MassProperties properties_of(const MassElement& element) {
  return {element.mass, element.r_EL_L, element.I_PntE_L};
}

PrincipalInertia principal_inertia(const Matrix3d& I) {
  const bool diagonal = I(0, 1) == 0.0 && I(0, 2) == 0.0 && I(1, 2) == 0.0;
  if (diagonal) return {I.diagonal(), Quaterniond::Identity()};
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(I);
  Matrix3d axes = solver.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(0) = -axes.col(0);
  return {solver.eigenvalues(), Quaterniond(axes).normalized()};
}

}  // namespace twincraft
