// See kepler.h. R. H. Battin, An Introduction to the Mathematics and Methods of Astrodynamics,
// section 4.3: Kepler's equation and the Lagrange coefficients in the difference of eccentric
// anomaly.  Tested by tests/runtime/reference_test.cpp.
#include "runtime/reference/kepler.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "compiler/ir/configuration.h"

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

namespace {

/// Is any force schedule of `load` not zero at some time in [0, duration)?
bool pushes(const Load& load, double duration) {
  return std::any_of(load.force_L.begin(), load.force_L.end(), [duration](const Schedule& force) {
    if (force.at(0.0) != 0.0) return true;
    const std::vector<double> times = event_times({&force}, duration);
    return std::any_of(times.begin(), times.end(),
                       [&force](double time) { return force.at(time) != 0.0; });
  });
}

bool is_elliptic(const Model& model) {
  const InitialState& initial = model.initial;
  const std::vector<LinkMotion> links =
      configuration(model.assembly, initial.joint_position, initial.joint_rate);
  const Vector3d c = system_properties(model.assembly, links).r_CL_L;
  const Vector3d c_dot = center_of_mass_rate(model.assembly, links) + initial.omega_BN_B.cross(c);
  const Vector3d r = initial.r_BN_N + initial.q_BN * c;
  const Vector3d v = initial.v_BN_N + initial.q_BN * c_dot;
  const Vector3d h = r.cross(v);
  // A straight fall (h = 0) has energy below zero too, but reaches the centre.
  return 0.5 * v.squaredNorm() < model.gravity.mu / r.norm() && h.norm() > 0.0;
}

}  // namespace

std::optional<std::string> kepler_inapplicable(const Model& model, GravityLaw law) {
  if (law == GravityLaw::kNone) return "there is no gravity";
  for (const Load& load : model.loads) {
    if (pushes(load, model.simulation.duration)) return "`" + load.name + "` applies a force";
  }
  if (law != GravityLaw::kSystemCom && !all_mass_at_one_point(model))
    return "gravity acts at several points, so the system centre of mass is not on a Kepler orbit; "
           "it is under `application: system_com`";
  if (!is_elliptic(model)) return "the initial state is not on an ellipse";
  return std::nullopt;
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
