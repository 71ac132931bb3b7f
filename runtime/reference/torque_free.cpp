// See torque_free.h. L. D. Landau and E. M. Lifshitz, Mechanics, section 37, for the rates; R. van
// Zon and J. Schofield, J. Comput. Phys. 225 (2007) 145, for the attitude. All differences of
// energies are formed from differences of moments, which loses nothing near steady rotation.
// Tested by tests/runtime/reference_test.cpp.
#include "runtime/reference/torque_free.h"

#include <algorithm>
#include <array>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_3.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <limits>

namespace twincraft {
namespace {

using Real = long double;

Real squared(Real x) { return x * x; }

}  // namespace

EulerTop::EulerTop(const Matrix3d& I_PntC_B, const Vector3d& omega_BN_B, const Quaterniond& q_BN)
    : omega0_BN_B_(omega_BN_B), q0_BN_(q_BN) {
  order_axes(I_PntC_B, omega_BN_B);
  const Vector omega = dcm_BP_.transpose() * omega_BN_B.cast<Real>();
  const Vector H = moments_.cwiseProduct(omega);
  momentum_ = H.norm();
  // Nothing turns the axis of a steady rotation but the rounding of what is given.
  constexpr Real kRounding = 4.0L * std::numeric_limits<double>::epsilon();
  is_steady_ = omega.cross(H).norm() <= kRounding * omega.norm() * momentum_;
  if (is_steady_) return;
  find_amplitudes(omega);
  third_at_start_ = elliptic(phase_).third;
  dcm_NH_ = q_BN.toRotationMatrix().cast<Real>() * dcm_BP_ * momentum_frame(omega).transpose();
}

void EulerTop::order_axes(const Matrix3d& I_PntC_B, const Vector3d& omega_BN_B) {
  const PrincipalInertia principal = principal_inertia(I_PntC_B);
  const Matrix axes = principal.axes.toRotationMatrix().cast<Real>();
  const Vector moments = principal.moments.cast<Real>();
  std::array<Eigen::Index, 3> order{0, 1, 2};
  std::ranges::sort(order, {}, [&](Eigen::Index axis) { return moments[axis]; });
  // |H|^2 - 2 T I2 says about which of the outer axes the momentum circles.
  const auto [a, b, c] = order;
  const Vector omega = axes.transpose() * omega_BN_B.cast<Real>();
  const Real excess = moments[a] * (moments[a] - moments[b]) * squared(omega[a]) +
                      moments[c] * (moments[c] - moments[b]) * squared(omega[c]);
  if (excess < 0.0L) std::swap(order[0], order[2]);
  for (Eigen::Index i = 0; i < 3; ++i) {
    dcm_BP_.col(i) = axes.col(order.at(static_cast<std::size_t>(i)));
    moments_[i] = moments[order.at(static_cast<std::size_t>(i))];
  }
  if (dcm_BP_.determinant() < 0.0L) dcm_BP_.col(0) = -dcm_BP_.col(0);
}

/// omega = (a1 cn, a2 sn, a3 dn) of u = wp t + epsilon.
void EulerTop::find_amplitudes(const Vector& omega) {
  const Real I1 = moments_[0], I2 = moments_[1], I3 = moments_[2];
  const Real outer = I2 * (I2 - I3) / (I1 * (I1 - I3));  // never negative, as `inner`
  const Real inner = I2 * (I2 - I1) / (I3 * (I3 - I1));
  amplitudes_[0] = std::sqrt(squared(omega[0]) + outer * squared(omega[1]));
  amplitudes_[2] =
      std::copysign(std::sqrt(squared(omega[2]) + inner * squared(omega[1])), omega[2]);
  // I1 dw1/dt = (I2 - I3) w2 w3 with w1 = a1 cn fixes the sign of a2.
  amplitudes_[1] = std::copysign(amplitudes_[0] / std::sqrt(outer), (I3 - I2) * amplitudes_[2]);
  frequency_ = std::abs(amplitudes_[2]) * std::sqrt((I1 - I3) / I1 * ((I2 - I3) / I2));
  modulus_ = std::min(1.0L, std::sqrt(inner) * std::abs(amplitudes_[1] / amplitudes_[2]));
  n_ = I3 * (I2 - I1) / (I1 * (I2 - I3));
  quarter_ = boost::math::ellint_1(modulus_);
  third_ = boost::math::ellint_3(modulus_, n_);
  phase_ = boost::math::ellint_1(modulus_,
                                 std::atan2(omega[1] / amplitudes_[1], omega[0] / amplitudes_[0]));
}

EulerTop::Elliptic EulerTop::elliptic(Real u) const {
  const Real half_turns = std::round(u / (2.0L * quarter_));
  const Real rest = u - 2.0L * half_turns * quarter_;  // in [-K, K]
  Elliptic at{};
  at.sn = boost::math::jacobi_elliptic(modulus_, rest, &at.cn, &at.dn);
  at.third =
      2.0L * half_turns * third_ + boost::math::ellint_3(modulus_, n_, std::atan2(at.sn, at.cn));
  if (std::remainder(half_turns, 2.0L) != 0.0L) {
    at.sn = -at.sn;
    at.cn = -at.cn;
  }
  return at;
}

EulerTop::Vector EulerTop::rates(const Elliptic& at) const {
  return amplitudes_.cwiseProduct(Vector(at.cn, at.sn, at.dn));
}

/// P components to a frame whose third axis is the angular momentum and whose first is
/// perpendicular to body axis 3.
EulerTop::Matrix EulerTop::momentum_frame(const Vector& omega) const {
  const Vector third = moments_.cwiseProduct(omega).normalized();
  const Vector first = Vector(third.y(), -third.x(), 0.0L).normalized();
  Matrix rows;
  rows << first.transpose(), third.cross(first).transpose(), third.transpose();
  return rows;
}

EulerTop::State EulerTop::steady(double time) const {
  const Vector3d& omega = omega0_BN_B_;
  if (omega.isZero(0.0)) return {omega, q0_BN_};
  constexpr Real kTurn = 2.0L * std::numbers::pi_v<Real>;
  const Real angle = omega.cast<Real>().norm() * static_cast<Real>(time);
  const Eigen::AngleAxisd turn(static_cast<double>(std::remainder(angle, kTurn)),
                               omega.normalized());
  return {omega, q0_BN_ * Quaterniond(turn)};
}

EulerTop::State EulerTop::at(double time) const {
  if (is_steady_) return steady(time);
  const Real t = time;
  const Elliptic now = elliptic(frequency_ * t + phase_);
  const Vector omega = rates(now);
  // psi' = H (I1 w1^2 + I2 w2^2) / (I1^2 w1^2 + I2^2 w2^2), integrated.
  const Real I1 = moments_[0], I3 = moments_[2];
  const Real psi =
      momentum_ * (t / I3 + (1.0L / I1 - 1.0L / I3) / frequency_ * (now.third - third_at_start_));
  const Matrix turn = Eigen::AngleAxis<Real>(psi, Vector::UnitZ()).toRotationMatrix();
  const Matrix dcm_NB = dcm_NH_ * turn * momentum_frame(omega) * dcm_BP_.transpose();
  return {(dcm_BP_ * omega).cast<double>(), Quaterniond(Matrix3d(dcm_NB.cast<double>()))};
}

std::vector<Deviation> torque_free_deviations(const Model& model,
                                              std::span<const Observation> samples) {
  const Observation& start = samples.front();
  const EulerTop top(hub_properties(model).I_PntC_L, start.omega_BN_B, start.q_BN);
  Deviation attitude{.metric = "attitude_deg"};
  Deviation rate{.metric = "rate_rad_s"};
  for (const Observation& sample : samples) {
    const EulerTop::State truth = top.at(sample.time - start.time);
    widen(attitude, angle_deg(truth.q_BN, sample.q_BN), sample.time);
    widen(rate, (sample.omega_BN_B - truth.omega_BN_B).norm(), sample.time);
  }
  return {attitude, rate};
}

}  // namespace twincraft
