// Symmetric 3x3 matrices as six numbers: what the recursion adds and eliminates in every link.
// Eigen's full matrices cost half as much again here. Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include "compiler/ir/mass.h"

namespace twincraft::bsm {

struct Sym3 {
  double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;

  static Sym3 isotropic(double value) { return {value, value, value, 0.0, 0.0, 0.0}; }
  static Sym3 from(const Matrix3d& m) {
    return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
  }
  /// The upper triangle of u v^T, where that or the sum it goes into is symmetric.
  static Sym3 from_parallel(const Vector3d& u, const Vector3d& v) {
    return {u.x() * v.x(), u.y() * v.y(), u.z() * v.z(),
            u.x() * v.y(), u.x() * v.z(), u.y() * v.z()};
  }
  Matrix3d full() const {
    Matrix3d m;
    m << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return m;
  }

  Vector3d operator*(const Vector3d& v) const {
    return {xx * v.x() + xy * v.y() + xz * v.z(), xy * v.x() + yy * v.y() + yz * v.z(),
            xz * v.x() + yz * v.y() + zz * v.z()};
  }

  Sym3& operator+=(const Sym3& o) {
    xx += o.xx;
    yy += o.yy;
    zz += o.zz;
    xy += o.xy;
    xz += o.xz;
    yz += o.yz;
    return *this;
  }

  friend Sym3 operator+(Sym3 a, const Sym3& b) { return a += b; }
  friend Sym3 operator*(double s, const Sym3& a) {
    return {s * a.xx, s * a.yy, s * a.zz, s * a.xy, s * a.xz, s * a.yz};
  }

  /// Take away u v^T, which is symmetric because v is a multiple of u.
  void subtract_parallel(const Vector3d& u, const Vector3d& v) {
    xx -= u.x() * v.x();
    yy -= u.y() * v.y();
    zz -= u.z() * v.z();
    xy -= u.x() * v.y();
    xz -= u.x() * v.z();
    yz -= u.y() * v.z();
  }

  /// Add Z + Z^T, Z given by its columns.
  void add_twice_symmetric(const Vector3d& z0, const Vector3d& z1, const Vector3d& z2) {
    xx += 2.0 * z0.x();
    yy += 2.0 * z1.y();
    zz += 2.0 * z2.z();
    xy += z1.x() + z0.y();
    xz += z2.x() + z0.z();
    yz += z2.y() + z1.z();
  }

  /// R this R^T
  Sym3 turned(const Matrix3d& R) const {
    const Vector3d a = *this * R.row(0).transpose();
    const Vector3d b = *this * R.row(1).transpose();
    const Vector3d c = *this * R.row(2).transpose();
    return {R.row(0).dot(a), R.row(1).dot(b), R.row(2).dot(c),
            R.row(0).dot(b), R.row(0).dot(c), R.row(1).dot(c)};
  }
};

/// L D L^T of a symmetric positive definite matrix.
class Ldl3 {
 public:
  explicit Ldl3(const Sym3& m) {
    inverse_d0_ = 1.0 / m.xx;
    l10_ = m.xy * inverse_d0_;
    l20_ = m.xz * inverse_d0_;
    inverse_d1_ = 1.0 / (m.yy - l10_ * m.xy);
    const double e21 = m.yz - l20_ * m.xy;
    l21_ = e21 * inverse_d1_;
    inverse_d2_ = 1.0 / (m.zz - l20_ * m.xz - l21_ * e21);
  }

  Vector3d solve(const Vector3d& b) const {
    const double y1 = b.y() - l10_ * b.x();
    const double y2 = b.z() - l20_ * b.x() - l21_ * y1;
    const double x2 = y2 * inverse_d2_;
    const double x1 = y1 * inverse_d1_ - l21_ * x2;
    return {b.x() * inverse_d0_ - l10_ * x1 - l20_ * x2, x1, x2};
  }

 private:
  double inverse_d0_, inverse_d1_, inverse_d2_, l10_, l20_, l21_;
};

}  // namespace twincraft::bsm
