// The two-body problem: the path of the system centre of mass under point gravity alone.
// Lagrange's f and g from the first sample, over the difference of eccentric anomaly, so that
// circular and equatorial orbits are nothing special, and in a form that keeps its digits up to the
// parabola. Exact for the law `system_com` always, for
// the others when all mass is at one point.  Tested by tests/runtime/reference_test.cpp.
#pragma once

#include "runtime/reference/reference.h"

namespace twincraft {

class KeplerOrbit {
 public:
  /// @param r, v  [m], [m/s] at t = 0   @param mu  [m^3/s^2]   @pre elliptic
  KeplerOrbit(const Vector3d& r, const Vector3d& v, double mu);

  struct State {
    Vector3d r;  // [m]
    Vector3d v;  // [m/s]
  };
  State at(double time) const;
  double period() const;  // [s]

 private:
  // Extended precision: a double holds 7000 km only to 1e-9 m, and the truth should be better.
  using Real = long double;
  using Vector = Eigen::Matrix<Real, 3, 1>;

  Real eccentric_difference(Real mean_difference) const;

  Vector r0_, v0_;
  Real mu_;
  Real radius_;    // |r0|
  Real a_;         // semi-major axis
  Real n_;         // mean motion [rad/s]
  Real r_over_a_;  // 1 - e cos E0
  Real e_cos_E_;   // e cos E0
  Real e_sin_E_;   // e sin E0
};

/// `position_m` and `velocity_m_s` of the system centre of mass.
std::vector<Deviation> kepler_deviations(const Model& model, std::span<const Observation> samples);

}  // namespace twincraft
