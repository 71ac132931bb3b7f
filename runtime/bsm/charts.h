// Attitude charts inside a step: rotation matrix, kinematics, and what keeps the chart regular.
// Schaub and Junkins, Analytical Mechanics of Space Systems, chapter 3.
// Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include "runtime/scalar/linear.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

using namespace ::twincraft::TWINCRAFT_KERNEL;

/// Modified Rodrigues parameters sigma_BN: three numbers, switched to their shadow outside the
/// unit ball.
template <KernelScalar S>
struct Mrp {
  Vec<S> sigma;

  Mrp(const Number<S>* state, int at)
      : sigma{entry<S>(state, at), entry<S>(state, at + 1), entry<S>(state, at + 2)} {}
  void put(Number<S>* state, int at) const {
    put_entry(state, at, sigma.x);
    put_entry(state, at + 1, sigma.y);
    put_entry(state, at + 2, sigma.z);
  }

  /// 1 + 8 sigma~ sigma~ / (1 + s2)^2 + 4 (1 - s2) sigma~ / (1 + s2)^2, with
  /// sigma~ sigma~ = sigma sigma^T - s2 1.
  Mat<S> dcm_NB() const {
    const S one(1.0), s2 = dot(sigma, sigma);
    const S inverse = one / ((one + s2) * (one + s2));
    const S eight = S(8.0) * inverse;
    Mat<S> dcm = cross_matrix((S(4.0) * (one - s2) * inverse) * sigma);
    const Vec<S> scaled = eight * sigma;
    dcm.x += sigma.x * scaled;
    dcm.y += sigma.y * scaled;
    dcm.z += sigma.z * scaled;
    const S diagonal = one - eight * s2;
    dcm.x.x += diagonal;
    dcm.y.y += diagonal;
    dcm.z.z += diagonal;
    return dcm;
  }

  /// sigmaDot = 1/4 [(1 - sigma^2) 1 + 2 sigma~ + 2 sigma sigma^T] omega
  void put_rate(const Vec<S>& omega_BN_B, Number<S>* rate, int at) const {
    Mrp dot_sigma = *this;
    const S half(0.5);
    dot_sigma.sigma = (S(0.25) - S(0.25) * dot(sigma, sigma)) * omega_BN_B +
                      half * (cross(sigma, omega_BN_B) + dot(sigma, omega_BN_B) * sigma);
    dot_sigma.put(rate, at);
  }

  void make_regular() {
    const S s2 = dot(sigma, sigma);
    const S one(1.0);
    sigma = chosen(s2 > one, S(-1.0) / s2, one) * sigma;
  }
};

/// Quaternion, scalar first, B to N: four numbers with their rate, normalised after a step. Within
/// a step it is read as if normalised, by its own rate too: the error of a step is then a third of
/// what the rate of a stage off the unit sphere leaves.
template <KernelScalar S>
struct Quaternion {
  S w;
  Vec<S> v;

  Quaternion(const S& w_of, const Vec<S>& v_of) : w(w_of), v(v_of) {}
  Quaternion(const Number<S>* state, int at)
      : w(entry<S>(state, at)),
        v{entry<S>(state, at + 1), entry<S>(state, at + 2), entry<S>(state, at + 3)} {}
  void put(Number<S>* state, int at) const {
    put_entry(state, at, w);
    put_entry(state, at + 1, v.x);
    put_entry(state, at + 2, v.y);
    put_entry(state, at + 3, v.z);
  }
  S squared_norm() const { return w * w + dot(v, v); }

  Mat<S> dcm_NB() const {
    const S two_over = S(2.0) / squared_norm();
    const Vec<S> s = two_over * v;
    const S xx = s.x * v.x, yy = s.y * v.y, zz = s.z * v.z;
    const S xy = s.x * v.y, xz = s.x * v.z, yz = s.y * v.z;
    const S wx = w * s.x, wy = w * s.y, wz = w * s.z;
    const S one(1.0);
    return {{one - yy - zz, xy + wz, xz - wy},
            {xy - wz, one - xx - zz, yz + wx},
            {xz + wy, yz - wx, one - xx - yy}};
  }

  /// qDot = 1/2 q (0, omega)
  void put_rate(const Vec<S>& omega_BN_B, Number<S>* rate, int at) const {
    const Vec<S> half = (S(0.5) / root(squared_norm())) * omega_BN_B;
    Quaternion q_dot = *this;
    q_dot.w = -dot(v, half);
    q_dot.v = w * half + cross(v, half);
    q_dot.put(rate, at);
  }

  Quaternion normalised() const {
    const S scale = S(1.0) / root(squared_norm());
    return {scale * w, scale * v};
  }
  void make_regular() { *this = normalised(); }
};

/// Its scalar is negative outside the unit ball.
template <KernelScalar S>
Quaternion<S> quaternion_of(const Mrp<S>& chart) {
  const S one(1.0), s2 = dot(chart.sigma, chart.sigma), inverse = one / (one + s2);
  return {(one - s2) * inverse, (S(2.0) * inverse) * chart.sigma};
}

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
