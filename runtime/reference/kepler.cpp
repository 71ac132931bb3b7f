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
  r_over_a_ = radius_ / a_;
  e_cos_E_ = 1.0L - r_over_a_;
  e_sin_E_ = r0_.dot(v0_) / std::sqrt(mu_ * a_);
}

double KeplerOrbit::period() const {
  return static_cast<double>(2.0L * std::numbers::pi_v<Real> / n_);
}

namespace {

using Real = long double;

/// 1 - cos x
Real versine(Real x) {
  const Real half = std::sin(0.5L * x);
  return 2.0L * half * half;
}

/// x - sin x
Real arc_excess(Real x) {
  if (std::abs(x) > 1.0L) return x - std::sin(x);
  Real term = x * x * x / 6.0L, sum = term;
  for (int n = 5; std::abs(term) > std::numeric_limits<Real>::epsilon() * std::abs(sum); n += 2) {
    term *= -x * x / static_cast<Real>(n * (n - 1));
    sum += term;
  }
  return sum;
}

}  // namespace

/// Newton on  M = r0/a x + e cos E0 (x - sin x) + e sin E0 (1 - cos x),  x = E - E0: near the
/// parabola all of x, M and r0/a are small, and x - e sin x would have lost what is left of it.
KeplerOrbit::Real KeplerOrbit::eccentric_difference(Real mean_difference) const {
  // The root is within 2e of M; the derivative is r/a > 0, so a bracket keeps Newton safe at any e.
  Real low = mean_difference - 2.0L;
  Real high = mean_difference + 2.0L;
  Real x = mean_difference;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Real residual =
        r_over_a_ * x + e_cos_E_ * arc_excess(x) + e_sin_E_ * versine(x) - mean_difference;
    (residual > 0.0L ? high : low) = x;
    const Real slope = r_over_a_ + e_cos_E_ * versine(x) + e_sin_E_ * std::sin(x);
    Real next = x - residual / slope;
    if (!(next > low && next < high)) next = 0.5L * (low + high);
    const Real change = std::abs(next - x);
    x = next;
    if (change <= 4.0L * std::numeric_limits<Real>::epsilon() * std::abs(x)) break;
  }
  return x;
}

KeplerOrbit::State KeplerOrbit::at(double time) const {
  constexpr Real kTurn = 2.0L * std::numbers::pi_v<Real>;
  const Real x = eccentric_difference(std::remainder(n_ * static_cast<Real>(time), kTurn));
  const Real sine = std::sin(x);
  const Real r = a_ * (r_over_a_ + e_cos_E_ * versine(x) + e_sin_E_ * sine);
  const Real f = 1.0L - versine(x) / r_over_a_;
  const Real g = (r_over_a_ * sine + e_sin_E_ * versine(x)) / n_;
  const Real f_dot = -std::sqrt(mu_ * a_) / (r * radius_) * sine;
  const Real g_dot = 1.0L - a_ / r * versine(x);
  return {(f * r0_ + g * v0_).cast<double>(), (f_dot * r0_ + g_dot * v0_).cast<double>()};
}

std::vector<Deviation> kepler_deviations(const Model& model, std::span<const Observation> samples) {
  const KeplerOrbit orbit(samples.front().r_CN_N, samples.front().v_CN_N, model.gravity.mu);
  Deviation position{.metric = "position_m"};
  Deviation velocity{.metric = "velocity_m_s"};
  for (const Observation& sample : samples) {
    const KeplerOrbit::State truth = orbit.at(sample.time - samples.front().time);
    position.see((sample.r_CN_N - truth.r).norm(), sample.time);
    velocity.see((sample.v_CN_N - truth.v).norm(), sample.time);
  }
  return {position, velocity};
}

}  // namespace twincraft
