// See kepler.h. R. H. Battin, An Introduction to the Mathematics and Methods of Astrodynamics,
// section 4.3: Kepler's equation and the Lagrange coefficients in the difference of eccentric
// anomaly.  Tested by tests/runtime/reference_test.cpp.
#include "runtime/reference/kepler.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace twincraft {

KeplerOrbit::KeplerOrbit(const Vector3d& r, const Vector3d& v, double mu)
    : r0_(r.cast<Real>()), v0_(v.cast<Real>()), mu_(mu), radius_(r0_.norm()) {
  a_ = 1.0L / (2.0L / radius_ - v0_.squaredNorm() / mu_);
  n_ = std::sqrt(mu_ / (a_ * a_ * a_));
  e_cos_E_ = 1.0L - radius_ / a_;
  e_sin_E_ = r0_.dot(v0_) / std::sqrt(mu_ * a_);
}

double KeplerOrbit::period() const {
  return static_cast<double>(2.0L * std::numbers::pi_v<Real> / n_);
}

/// Newton on  M = x - e cos E0 sin x + e sin E0 (1 - cos x),  x = E - E0.
KeplerOrbit::Real KeplerOrbit::eccentric_difference(Real mean_difference) const {
  // The root is within 2e of M; the derivative is r/a > 0, so a bracket keeps Newton safe at any e.
  Real low = mean_difference - 2.0L;
  Real high = mean_difference + 2.0L;
  Real x = mean_difference;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Real sine = std::sin(x);
    const Real versine = 1.0L - std::cos(x);
    const Real residual = x - e_cos_E_ * sine + e_sin_E_ * versine - mean_difference;
    (residual > 0.0L ? high : low) = x;
    const Real slope = 1.0L - e_cos_E_ * (1.0L - versine) + e_sin_E_ * sine;
    Real next = x - residual / slope;
    if (!(next > low && next < high)) next = 0.5L * (low + high);
    const Real change = std::abs(next - x);
    x = next;
    if (change <= 4.0L * std::numeric_limits<Real>::epsilon() * (1.0L + std::abs(x))) break;
  }
  return x;
}

KeplerOrbit::State KeplerOrbit::at(double time) const {
  constexpr Real kTurn = 2.0L * std::numbers::pi_v<Real>;
  const Real x = eccentric_difference(std::remainder(n_ * static_cast<Real>(time), kTurn));
  const Real sine = std::sin(x);
  const Real versine = 1.0L - std::cos(x);
  const Real r = a_ * (1.0L - e_cos_E_ * (1.0L - versine) + e_sin_E_ * sine);
  const Real f = 1.0L - a_ / radius_ * versine;
  const Real g = (radius_ / a_ * sine + e_sin_E_ * versine) / n_;
  const Real f_dot = -std::sqrt(mu_ * a_) / (r * radius_) * sine;
  const Real g_dot = 1.0L - a_ / r * versine;
  return {(f * r0_ + g * v0_).cast<double>(), (f_dot * r0_ + g_dot * v0_).cast<double>()};
}

std::vector<Deviation> kepler_deviations(const Model& model, std::span<const Observation> samples) {
  const KeplerOrbit orbit(samples.front().r_CN_N, samples.front().v_CN_N, model.gravity.mu);
  Deviation position{.metric = "position_m"};
  Deviation velocity{.metric = "velocity_m_s"};
  for (const Observation& sample : samples) {
    const KeplerOrbit::State truth = orbit.at(sample.time - samples.front().time);
    widen(position, (sample.r_CN_N - truth.r).norm(), sample.time);
    widen(velocity, (sample.v_CN_N - truth.v).norm(), sample.time);
  }
  return {position, velocity};
}

}  // namespace twincraft
