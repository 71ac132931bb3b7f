// See torque_free.h. L. D. Landau and E. M. Lifshitz, Mechanics, section 37, for the rates; R. van
// Zon and J. Schofield, J. Comput. Phys. 225 (2007) 145, for the attitude; DLMF 19.25 for Carlson's
// forms of the integrals.
#include "runtime/reference/torque_free.h"

#include <algorithm>
#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "compiler/ir/angle.h"

namespace twincraft {
namespace {

template <class T>
T squared(const T& x) {
  return x * x;
}

/// A symmetric matrix on its way to a diagonal one, and the eigenvectors, as columns.
template <class Exact>
struct Diagonalised {
  std::array<std::array<Exact, 3>, 3> matrix, vectors;
};

/// One rotation of Jacobi's method, which zeroes the element (p, q).
template <class Exact>
void rotate(Diagonalised<Exact>& at, std::size_t p, std::size_t q) {
  auto& m = at.matrix;
  const Exact theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
  const Exact size = 1 / (abs(theta) + sqrt(squared(theta) + 1));
  const Exact t = theta < 0 ? Exact(-size) : size;
  const Exact c = 1 / sqrt(squared(t) + 1);
  const Exact s = t * c;
  m[p][p] -= t * m[p][q];
  m[q][q] += t * m[p][q];
  m[p][q] = m[q][p] = 0;
  const std::size_t other = 3 - p - q;
  const Exact to_p = m[other][p], to_q = m[other][q];
  m[other][p] = m[p][other] = c * to_p - s * to_q;
  m[other][q] = m[q][other] = s * to_p + c * to_q;
  for (auto& row : at.vectors) {
    const Exact a = row[p], b = row[q];
    row[p] = c * a - s * b;
    row[q] = s * a + c * b;
  }
}

/// Leaves a diagonal matrix exactly as it is.
template <class Exact>
Diagonalised<Exact> diagonalised(const Matrix3d& symmetric) {
  Diagonalised<Exact> at;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const auto row = static_cast<Eigen::Index>(std::min(i, j));
      at.matrix[i][j] = symmetric(row, static_cast<Eigen::Index>(std::max(i, j)));
      at.vectors[i][j] = i == j ? 1 : 0;
    }
  const Exact rounding = std::numeric_limits<Exact>::epsilon() * symmetric.trace();
  constexpr int kSweeps = 30;  // it takes six or seven
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (const auto& [p, q] : {std::pair{0U, 1U}, std::pair{0U, 2U}, std::pair{1U, 2U}}) {
      if (abs(at.matrix[p][q]) <= rounding) at.matrix[p][q] = at.matrix[q][p] = 0;
      if (at.matrix[p][q] != 0) rotate(at, p, q);
    }
  return at;
}

/// P = Pi - u of an argument u with these functions, for the characteristic -N.
template <class T>
T third_kind(const T& sn, const T& cn, const T& dn, const T& N) {
  const T one = 1;
  const T integral = boost::math::ellint_rj(T(cn * cn), T(dn * dn), one, T(1 + N * squared(sn)));
  return -N / 3 * sn * squared(sn) * integral;
}

/// In [-pi, pi].
template <class Exact>
Exact remainder_of_turn(const Exact& angle) {
  const Exact& turn = boost::math::constants::two_pi<Exact>();
  return angle - turn * round(angle / turn);
}

JacobiFunctions hyperbolic(long double u) {
  const long double sech = 1.0L / std::cosh(u);
  return {std::tanh(u), sech, sech};
}

}  // namespace

EulerTop::EulerTop(const Matrix3d& I_PntC_B, const Vector3d& omega_BN_B, const Quaterniond& q_BN)
    : omega0_BN_B_(omega_BN_B), q0_BN_(q_BN) {
  order_axes(I_PntC_B, omega_BN_B);
  const auto& [I1, I2, I3] = moments_;
  const auto& [w1, w2, w3] = omega0_P_;
  is_steady_ = (I2 - I3) * w2 * w3 == 0 && (I3 - I1) * w3 * w1 == 0 && (I1 - I2) * w1 * w2 == 0;
  if (is_steady_) return;
  find_motion();
  const Vector omega(static_cast<Real>(w1), static_cast<Real>(w2), static_cast<Real>(w3));
  Eigen::Quaternion<Real> q = q_BN.cast<Real>();
  q.normalize();
  dcm_NH_ = q.toRotationMatrix() * dcm_BP_ * momentum_frame(omega).transpose();
}

void EulerTop::order_axes(const Matrix3d& I_PntC_B, const Vector3d& omega_BN_B) {
  const Diagonalised<Exact> principal = diagonalised<Exact>(I_PntC_B);
  const auto moment = [&](std::size_t axis) { return principal.matrix[axis][axis]; };
  const auto rate = [&](std::size_t axis) {
    Exact sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
      sum += principal.vectors[i][axis] * omega_BN_B[static_cast<Eigen::Index>(i)];
    return sum;
  };
  std::array<std::size_t, 3> order{0, 1, 2};
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return moment(a) < moment(b); });
  // |H|^2 - 2 T I2 says about which of the outer axes the momentum circles.
  const auto [a, b, c] = order;
  const Exact excess = moment(a) * (moment(a) - moment(b)) * squared(rate(a)) +
                       moment(c) * (moment(c) - moment(b)) * squared(rate(c));
  if (excess < 0) std::swap(order[0], order[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    moments_[i] = moment(order[i]);
    omega0_P_[i] = rate(order[i]);
    for (std::size_t j = 0; j < 3; ++j)
      dcm_BP_(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) =
          static_cast<Real>(principal.vectors[j][order[i]]);
  }
  if (dcm_BP_.determinant() > 0.0L) return;
  dcm_BP_.col(0) = -dcm_BP_.col(0);
  omega0_P_[0] = -omega0_P_[0];
}

/// omega = (a1 cn, a2 sn, a3 dn) of u = wp t + epsilon, with a1 signed so that epsilon is within
/// a quarter period of 0. Differences of energies are formed from differences of moments.
void EulerTop::find_motion() {
  const auto& [I1, I2, I3] = moments_;
  const auto& [w1, w2, w3] = omega0_P_;
  const Exact d12 = abs(I1 - I2), d23 = abs(I2 - I3), d13 = abs(I1 - I3);
  const Exact outer = I2 * d23 / (I1 * d13);
  const Exact inner = I2 * d12 / (I3 * d13);
  const Exact a1 = sqrt(squared(w1) + outer * squared(w2));
  const Exact a2 = a1 / sqrt(outer);
  const Exact a3 = sqrt(squared(w3) + inner * squared(w2));
  // I1 dw1/dt = (I2 - I3) w2 w3 has the sign of a2 follow from the others.
  const int sign1 = w1 < 0 ? -1 : 1;
  const int sign3 = w3 < 0 ? -1 : 1;
  const int sign2 = sign1 * sign3 * (I3 > I2 ? 1 : -1);
  amplitudes_ = {static_cast<Real>(sign1 * a1), static_cast<Real>(sign2 * a2),
                 static_cast<Real>(sign3 * a3)};
  frequency_ = a3 * sqrt(d13 / I1 * (d23 / I2));
  complement_ = sqrt((I3 * d23 * squared(w3) - I1 * d12 * squared(w1)) / (I3 * d23 * squared(a3)));
  const Exact one = 1;
  const Exact sn = sign2 * w2 / a2, cn = sign1 * w1 / a1, dn = sign3 * w3 / a3;
  phase_ = sn * boost::math::ellint_rf(squared(cn), squared(dn), one);
  find_turn(squared(Exact(I1 * a1 / (I3 * a3))));
  turn_at_start_ = third_kind(sn, cn, dn, N_);
  if (complement_ == 0) return;
  quarter_ = boost::math::ellint_rf(Exact(0), squared(complement_), one);
  turn_in_quarter_ = third_kind(one, Exact(0), complement_, N_);
}

/// The turn of the line across H and a body axis, for the outer axis that keeps well away from H:
///   turn' = H (2 T - I w^2) / (H^2 - I^2 w^2) = H/I' + H (1/I - 1/I') (1 - 1/(1 + N sn^2)),
/// I its own moment and w its rate, I' the moment of the other outer axis. Then N is not large and
/// nothing cancels; of the other axis it is k^2/N.
/// @param slope  N of the first axis
void EulerTop::find_turn(const Exact& slope) {
  const auto& [I1, I2, I3] = moments_;
  const Exact of_third = I3 * abs(I1 - I2) / (I1 * abs(I2 - I3));
  turn_axis_ = of_third <= 1 ? 2 : 0;
  N_ = of_third <= 1 ? of_third : slope;
  const Exact& own = of_third <= 1 ? I3 : I1;
  const Exact& other = of_third <= 1 ? I1 : I3;
  const Exact momentum =
      sqrt(squared(Exact(I1 * omega0_P_[0])) + squared(Exact(I2 * omega0_P_[1])) +
           squared(Exact(I3 * omega0_P_[2])));
  turn_rate_ = momentum / other;
  turn_factor_ = momentum / frequency_ * (1 / other - 1 / own);
}

/// P(u) within a quarter period of 0.
EulerTop::Real EulerTop::turn_within(Real u, const JacobiFunctions& at) const {
  const Real N = static_cast<Real>(N_);
  if (complement_ != 0) return third_kind(at.sn, at.cn, at.dn, N);
  // On the separatrix sn = tanh u, and the integral is an elementary one that goes on for ever.
  const Real root = std::sqrt(N);
  return (root * std::atan(root * at.sn) - N * u) / (1.0L + N);
}

EulerTop::Phase EulerTop::phase_at(double time) const {
  const Exact u = frequency_ * time + phase_;
  const bool is_periodic = complement_ != 0;
  const Exact half_turns = is_periodic ? Exact(round(u / (2 * quarter_))) : Exact(0);
  const Exact rest = is_periodic ? Exact(u - 2 * half_turns * quarter_) : u;  // in [-K, K]
  const Real argument = static_cast<Real>(rest);
  Phase at{};
  at.functions = is_periodic ? jacobi(argument, static_cast<Real>(Exact(quarter_ - abs(rest))),
                                      static_cast<Real>(complement_))
                             : hyperbolic(argument);
  const Exact angle =
      turn_rate_ * time + turn_factor_ * (2 * half_turns * turn_in_quarter_ - turn_at_start_);
  at.turn = static_cast<Real>(remainder_of_turn(angle)) +
            static_cast<Real>(turn_factor_) * turn_within(argument, at.functions);
  if (half_turns != 2 * floor(half_turns / 2)) {
    at.functions.sn = -at.functions.sn;
    at.functions.cn = -at.functions.cn;
  }
  return at;
}

/// P components to a frame whose third axis is the angular momentum and whose first is
/// perpendicular to it and to the axis of the turn.
EulerTop::Matrix EulerTop::momentum_frame(const Vector& omega) const {
  Vector H;
  for (Eigen::Index i = 0; i < 3; ++i)
    H[i] = static_cast<Real>(moments_[static_cast<std::size_t>(i)]) * omega[i];
  const Vector third = H.normalized();
  const Vector first = third.cross(Vector::Unit(turn_axis_)).normalized();
  Matrix rows;
  rows << first.transpose(), third.cross(first).transpose(), third.transpose();
  return rows;
}

EulerTop::State EulerTop::steady(double time) const {
  const Vector3d& omega = omega0_BN_B_;
  if (omega.isZero(0.0)) return {omega, q0_BN_};
  using std::sqrt;
  const Exact rate =
      sqrt(squared(Exact(omega.x())) + squared(Exact(omega.y())) + squared(Exact(omega.z())));
  const Real angle = static_cast<Real>(remainder_of_turn(Exact(rate * time)));
  const Eigen::AngleAxis<Real> turn(angle, omega.cast<Real>().normalized());
  const Eigen::Quaternion<Real> q = q0_BN_.cast<Real>() * Eigen::Quaternion<Real>(turn);
  return {omega, q.cast<double>()};
}

EulerTop::State EulerTop::at(double time) const {
  if (is_steady_) return steady(time);
  const Phase now = phase_at(time);
  const auto& [sn, cn, dn] = now.functions;
  const Vector omega = amplitudes_.cwiseProduct(Vector(cn, sn, dn));
  const Matrix turn = Eigen::AngleAxis<Real>(now.turn, Vector::UnitZ()).toRotationMatrix();
  const Matrix dcm_NB = dcm_NH_ * turn * momentum_frame(omega) * dcm_BP_.transpose();
  return {(dcm_BP_ * omega).cast<double>(), Eigen::Quaternion<Real>(dcm_NB).cast<double>()};
}

std::vector<Deviation> torque_free_deviations(const Model& model,
                                              std::span<const Observation> samples) {
  const Observation& start = samples.front();
  const EulerTop top(hub_properties(model).I_PntC_L, start.omega_BN_B, start.q_BN);
  Deviation attitude{.metric = "attitude_deg"};
  Deviation rate{.metric = "rate_rad_s"};
  for (const Observation& sample : samples) {
    const EulerTop::State truth = top.at(sample.time - start.time);
    attitude.see(kDegrees * principal_angle(truth.q_BN, sample.q_BN), sample.time);
    rate.see((sample.omega_BN_B - truth.omega_BN_B).norm(), sample.time);
  }
  return {attitude, rate};
}

}  // namespace twincraft
