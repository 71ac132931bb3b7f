// Vectors of three and matrices of nine or six in any scalar: plain structs, so that the
// compiler keeps them in registers. Tested by tests/runtime/kernel_test.cpp.
#pragma once

#include "compiler/ir/mass.h"
#include "runtime/scalar/scalar.h"

namespace twincraft::TWINCRAFT_KERNEL {

/// GCC 12 copies a struct of registers wider than these piece by piece, and who then reads it waits
/// until all pieces have left the store buffer. Of wide ones copies are written number by number.
template <class S>
inline constexpr bool kIsWide = sizeof(S) > sizeof(Pair);

template <KernelScalar S>
struct Vec {
  S x{}, y{}, z{};

  Vec() = default;
  Vec(const S& x_of, const S& y_of, const S& z_of) : x(x_of), y(y_of), z(z_of) {}
  Vec(const Vec&) = default;
  Vec& operator=(const Vec&) = default;
  Vec(const Vec& o) requires kIsWide<S> : x(o.x), y(o.y), z(o.z) {}
  // NOLINTNEXTLINE(modernize-use-equals-default)
  Vec& operator=(const Vec& o) requires kIsWide<S> {
    x = o.x;
    y = o.y;
    z = o.z;
    return *this;
  }
  Vec& operator+=(const Vec& o) {
    x += o.x;
    y += o.y;
    z += o.z;
    return *this;
  }
  Vec& operator-=(const Vec& o) {
    x -= o.x;
    y -= o.y;
    z -= o.z;
    return *this;
  }
  friend Vec operator+(Vec a, const Vec& b) { return a += b; }
  friend Vec operator-(Vec a, const Vec& b) { return a -= b; }
  friend Vec operator-(const Vec& a) { return {-a.x, -a.y, -a.z}; }
  friend Vec operator*(const S& s, const Vec& a) { return {s * a.x, s * a.y, s * a.z}; }
};

template <class S>
S dot(const Vec<S>& a, const Vec<S>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class S>
Vec<S> cross(const Vec<S>& a, const Vec<S>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// v + a x b. So written, each product and sum rounds once where the set fuses them.
template <class S>
Vec<S> plus_cross(const Vec<S>& v, const Vec<S>& a, const Vec<S>& b) {
  return {v.x + a.y * b.z - a.z * b.y, v.y + a.z * b.x - a.x * b.z, v.z + a.x * b.y - a.y * b.x};
}

/// By columns.
template <KernelScalar S>
struct Mat {
  Vec<S> x, y, z;

  Vec<S> operator*(const Vec<S>& v) const { return v.x * x + v.y * y + v.z * z; }
  Mat operator*(const Mat& m) const { return {*this * m.x, *this * m.y, *this * m.z}; }
  Mat& operator+=(const Mat& o) {
    x += o.x;
    y += o.y;
    z += o.z;
    return *this;
  }
  const Vec<S>& column_x() const { return x; }
  const Vec<S>& column_y() const { return y; }
  const Vec<S>& column_z() const { return z; }
  /// Add the matrix of v x, and no zeros.
  void add_cross_matrix(const Vec<S>& v) {
    x.y += v.z;
    x.z -= v.y;
    y.x -= v.z;
    y.z += v.x;
    z.x += v.y;
    z.y -= v.x;
  }
  Vec<S> row_x() const { return {x.x, y.x, z.x}; }
  Vec<S> row_y() const { return {x.y, y.y, z.y}; }
  Vec<S> row_z() const { return {x.z, y.z, z.z}; }
  /// Take away u v^T.
  void subtract(const Vec<S>& u, const Vec<S>& v) {
    x -= v.x * u;
    y -= v.y * u;
    z -= v.z * u;
  }
};

/// v + m a, fused like plus_cross().
template <class S, class M>
[[gnu::always_inline]] inline Vec<S> plus_product(const Vec<S>& v, const M& m, const Vec<S>& a) {
  const Vec<S>&x = m.column_x(), &y = m.column_y(), &z = m.column_z();
  return {v.x + x.x * a.x + y.x * a.y + z.x * a.z, v.y + x.y * a.x + y.y * a.y + z.y * a.z,
          v.z + x.z * a.x + y.z * a.y + z.z * a.z};
}

/// m^T v
template <class S>
Vec<S> transposed(const Mat<S>& m, const Vec<S>& v) {
  return {dot(m.x, v), dot(m.y, v), dot(m.z, v)};
}

/// v + m^T a, fused like plus_cross().
template <class S>
Vec<S> plus_transposed(const Vec<S>& v, const Mat<S>& m, const Vec<S>& a) {
  return {v.x + m.x.x * a.x + m.x.y * a.y + m.x.z * a.z,
          v.y + m.y.x * a.x + m.y.y * a.y + m.y.z * a.z,
          v.z + m.z.x * a.x + m.z.y * a.y + m.z.z * a.z};
}

/// The matrix of v x.
template <class S>
Mat<S> cross_matrix(const Vec<S>& v) {
  const S zero(0.0);
  return {{zero, v.z, -v.y}, {-v.z, zero, v.x}, {v.y, -v.x, zero}};
}

/// A symmetric matrix: what the recursion adds and eliminates in every link.
template <KernelScalar S>
struct Sym {
  S xx{}, yy{}, zz{}, xy{}, xz{}, yz{};

  Sym() = default;
  Sym(const S& xx_of, const S& yy_of, const S& zz_of, const S& xy_of, const S& xz_of,
      const S& yz_of)
      : xx(xx_of), yy(yy_of), zz(zz_of), xy(xy_of), xz(xz_of), yz(yz_of) {}
  Sym(const Sym&) = default;
  Sym& operator=(const Sym&) = default;
  Sym(const Sym& o) requires kIsWide<S>
      : xx(o.xx), yy(o.yy), zz(o.zz), xy(o.xy), xz(o.xz), yz(o.yz) {}
  // NOLINTNEXTLINE(modernize-use-equals-default)
  Sym& operator=(const Sym& o) requires kIsWide<S> {
    xx = o.xx;
    yy = o.yy;
    zz = o.zz;
    xy = o.xy;
    xz = o.xz;
    yz = o.yz;
    return *this;
  }

  static Sym isotropic(const S& value) { return {value, value, value, S(0.0), S(0.0), S(0.0)}; }
  /// The upper triangle of u v^T, where that or the sum it goes into is symmetric.
  static Sym parallel(const Vec<S>& u, const Vec<S>& v) {
    return {u.x * v.x, u.y * v.y, u.z * v.z, u.x * v.y, u.x * v.z, u.y * v.z};
  }

  Vec<S> operator*(const Vec<S>& v) const {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
            xz * v.x + yz * v.y + zz * v.z};
  }
  Vec<S> column_x() const { return {xx, xy, xz}; }
  Vec<S> column_y() const { return {xy, yy, yz}; }
  Vec<S> column_z() const { return {xz, yz, zz}; }

  Sym& operator+=(const Sym& o) {
    xx += o.xx;
    yy += o.yy;
    zz += o.zz;
    xy += o.xy;
    xz += o.xz;
    yz += o.yz;
    return *this;
  }
  friend Sym operator+(Sym a, const Sym& b) { return a += b; }
  friend Sym operator*(const S& s, const Sym& a) {
    return {s * a.xx, s * a.yy, s * a.zz, s * a.xy, s * a.xz, s * a.yz};
  }

  /// Add a multiple of the unit matrix, and no zeros.
  void add_isotropic(const S& value) {
    xx += value;
    yy += value;
    zz += value;
  }

  /// Take away u v^T, which is symmetric because v is a multiple of u.
  void subtract(const Vec<S>& u, const Vec<S>& v) {
    xx -= u.x * v.x;
    yy -= u.y * v.y;
    zz -= u.z * v.z;
    xy -= u.x * v.y;
    xz -= u.x * v.z;
    yz -= u.y * v.z;
  }

  /// R this R^T
  Sym turned(const Mat<S>& R) const {
    const Vec<S> rx = R.row_x(), ry = R.row_y(), rz = R.row_z();
    const Vec<S> a = *this * rx, b = *this * ry, c = *this * rz;
    return {dot(rx, a), dot(ry, b), dot(rz, c), dot(rx, b), dot(rx, c), dot(ry, c)};
  }
};

/// L D L^T of a symmetric positive definite matrix.
template <KernelScalar S>
class Ldl {
 public:
  Ldl() = default;
  /// By minors, so that the three quotients do not wait for one another. Each difference is one of
  /// the usual elimination's, scaled, and rounds no worse.
  explicit Ldl(const Sym<S>& m) {
    const S one(1.0);
    const S minor = m.xx * m.yy - m.xy * m.xy;
    const S e21 = m.xx * m.yz - m.xy * m.xz;
    const S e22 = m.xx * m.zz - m.xz * m.xz;
    const S inverse_minor = one / minor;
    inverse_d0_ = one / m.xx;
    inverse_d1_ = m.xx * inverse_minor;
    inverse_d2_ = (m.xx * minor) / (minor * e22 - e21 * e21);
    l10_ = m.xy * inverse_d0_;
    l20_ = m.xz * inverse_d0_;
    l21_ = e21 * inverse_minor;
  }

  Vec<S> solve(const Vec<S>& b) const {
    const S y1 = b.y - l10_ * b.x;
    const S y2 = b.z - l20_ * b.x - l21_ * y1;
    const S x2 = y2 * inverse_d2_;
    const S x1 = y1 * inverse_d1_ - l21_ * x2;
    return {b.x * inverse_d0_ - l20_ * x2 - l10_ * x1, x1, x2};
  }

  /// Where the same matrix is solved for often: a product does not wait for itself as solve() does.
  Sym<S> inverse() const {
    const S one(1.0), zero(0.0);
    const Vec<S> x = solve({one, zero, zero}), y = solve({zero, one, zero}),
                 z = solve({zero, zero, one});
    return {x.x, y.y, z.z, x.y, x.z, y.z};
  }

 private:
  S inverse_d0_{}, inverse_d1_{}, inverse_d2_{}, l10_{}, l20_{}, l21_{};
};

/// From Eigen and back, one double each.
inline Vec<double> vec(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Mat<double> mat(const Matrix3d& m) { return {vec(m.col(0)), vec(m.col(1)), vec(m.col(2))}; }
inline Vector3d eigen(const Vec<double>& v) { return {v.x, v.y, v.z}; }
inline Matrix3d eigen(const Sym<double>& m) {
  Matrix3d full;
  full << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
  return full;
}

/// From Eigen, into one lane or into all.
template <class S>
void set_lane(Vec<S>& v, std::size_t index, const Eigen::Matrix<Number<S>, 3, 1>& to) {
  set_lane(v.x, index, to.x());
  set_lane(v.y, index, to.y());
  set_lane(v.z, index, to.z());
}
template <class S>
requires(!std::same_as<Number<S>, double>) void set_lane(Vec<S>& v, std::size_t index,
                                                         const Vector3d& constant) {
  set_lane(v.x, index, constant.x());
  set_lane(v.y, index, constant.y());
  set_lane(v.z, index, constant.z());
}
template <class S>
void set_lane(Mat<S>& m, std::size_t index, const Matrix3d& to) {
  set_lane(m.x, index, Vector3d(to.col(0)));
  set_lane(m.y, index, Vector3d(to.col(1)));
  set_lane(m.z, index, Vector3d(to.col(2)));
}
template <class S>
void set_lane(Sym<S>& m, std::size_t index, const Matrix3d& to) {
  set_lane(m.xx, index, to(0, 0));
  set_lane(m.yy, index, to(1, 1));
  set_lane(m.zz, index, to(2, 2));
  set_lane(m.xy, index, to(0, 1));
  set_lane(m.xz, index, to(0, 2));
  set_lane(m.yz, index, to(1, 2));
}

}  // namespace twincraft::TWINCRAFT_KERNEL
