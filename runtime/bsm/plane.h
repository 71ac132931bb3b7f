// Vectors and symmetric matrices in the plane of a chain, (x, z).
//
// GCC 12 copies a struct of two wide registers through general ones, so that who reads it next
// waits for the store buffer. Copies are therefore written number by number. Tested by
// tests/runtime/bsm_test.cpp.
#pragma once

#include "runtime/scalar/linear.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

using namespace ::twincraft::TWINCRAFT_KERNEL;

template <class S>
struct Vec2 {
  S x{}, z{};

  Vec2() = default;
  Vec2(const S& x_of, const S& z_of) : x(x_of), z(z_of) {}
  Vec2(const Vec2& o) : x(o.x), z(o.z) {}
  Vec2& operator=(const Vec2& o) {  // NOLINT(modernize-use-equals-default): see above
    x = o.x;
    z = o.z;
    return *this;
  }
  Vec2& operator+=(const Vec2& o) {
    x += o.x;
    z += o.z;
    return *this;
  }
  Vec2& operator-=(const Vec2& o) {
    x -= o.x;
    z -= o.z;
    return *this;
  }
  friend Vec2 operator+(Vec2 a, const Vec2& b) { return a += b; }
  friend Vec2 operator-(Vec2 a, const Vec2& b) { return a -= b; }
  friend Vec2 operator*(const S& s, const Vec2& a) { return {s * a.x, s * a.z}; }
};

template <class S>
S dot(const Vec2<S>& a, const Vec2<S>& b) {
  return a.x * b.x + a.z * b.z;
}
template <class S>
Vec2<S> perp(const Vec2<S>& v) {
  return {v.z, -v.x};
}
template <class S>
Vec2<S> in_plane(const Vec<S>& v) {
  return {v.x, v.z};
}

/// Symmetric 2x2 in (x, z).
template <class S>
struct Plane {
  S xx{}, zz{}, xz{};

  Vec2<S> operator*(const Vec2<S>& v) const { return {xx * v.x + xz * v.z, xz * v.x + zz * v.z}; }
  Sym<S> in_axes(const Vec<S>& x, const Vec<S>& z) const {
    return Sym<S>::parallel(xx * x + xz * z, x) + Sym<S>::parallel(xz * x + zz * z, z);
  }
};

/// What is left of a symmetric 2x2 without its mean, [half xz; xz -half]: it turns by twice the
/// angle.
template <class S>
struct Deviator {
  S half{}, xz{};

  Deviator() = default;
  Deviator(const S& half_of, const S& xz_of) : half(half_of), xz(xz_of) {}
  Deviator(const Deviator& o) : half(o.half), xz(o.xz) {}
  Deviator& operator=(const Deviator& o) {  // NOLINT(modernize-use-equals-default): see above
    half = o.half;
    xz = o.xz;
    return *this;
  }
  Vec2<S> operator*(const Vec2<S>& v) const {
    return {half * v.x + xz * v.z, xz * v.x - half * v.z};
  }
};

/// From x to z, by the angle of these.
template <class S>
Vec2<S> turned(const Vec2<S>& v, const SineCosine<S>& by) {
  return {by.cosine * v.x - by.sine * v.z, by.cosine * v.z + by.sine * v.x};
}
/// @tparam kHasXz  else G has none
template <bool kHasXz, class S>
Deviator<S> turned(const Deviator<S>& G, const SineCosine<S>& by) {
  const S twice = by.sine + by.sine;
  const S sine = twice * by.cosine, cosine = S(1.0) - twice * by.sine;  // of the double angle
  if constexpr (!kHasXz) return {cosine * G.half, sine * G.half};
  return {cosine * G.half - sine * G.xz, cosine * G.xz + sine * G.half};
}

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
