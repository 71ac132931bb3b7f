// A rigid body that nothing turns from outside: Euler's top. Its rates are Jacobi's elliptic
// functions of time; its attitude adds an elliptic integral of the third kind, the turn about the
// angular momentum that stays where it is. Exact at any time, without steps, for any inertia and
// any rate.
//
// All that is ill-conditioned is a constant of the motion: how far it is from the separatrix, its
// period, its phase, its turn per period. These are formed once, with 50 digits from the doubles
// given. What is left is a smooth function within half a period, for which extended precision is
// plenty.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "runtime/reference/jacobi.h"
#include "runtime/reference/reference.h"

namespace twincraft {

class EulerTop {
 public:
  /// @param I_PntC_B  [kg m^2]   @param omega_BN_B, q_BN  [rad/s] and B to N components at t = 0
  EulerTop(const Matrix3d& I_PntC_B, const Vector3d& omega_BN_B, const Quaterniond& q_BN);

  struct State {
    Vector3d omega_BN_B;  // [rad/s]
    Quaterniond q_BN;     // B to N components
  };
  State at(double time) const;

 private:
  using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                              boost::multiprecision::et_off>;
  using Real = long double;
  using Vector = Eigen::Matrix<Real, 3, 1>;
  using Matrix = Eigen::Matrix<Real, 3, 3>;
  using Three = std::array<Exact, 3>;

  struct Phase {
    JacobiFunctions functions;  // of u = wp t + epsilon
    Real turn;                  // about the angular momentum since t = 0 [rad]
  };

  void order_axes(const Matrix3d& I_PntC_B, const Vector3d& omega_BN_B);
  void find_motion();
  void find_turn(const Exact& slope);
  Phase phase_at(double time) const;
  Real turn_within(Real u, const JacobiFunctions& at) const;
  Matrix momentum_frame(const Vector& omega) const;
  State steady(double time) const;

  // Of the principal axes P, ordered: the second has the middle moment, and about the third the
  // rate never vanishes.
  Three moments_;   // [kg m^2]
  Three omega0_P_;  // [rad/s] at t = 0
  Matrix dcm_BP_;

  bool is_steady_ = false;  // the rates stay as they are
  Vector amplitudes_;       // [rad/s] of cn, sn, dn; signs included
  Exact frequency_;         // wp [rad/s]
  Exact phase_;             // epsilon, in [-K, K]
  Exact complement_;        // k'; 0 on the separatrix
  Exact quarter_;           // K; unused on the separatrix

  // turn = turn_rate t + turn_factor (P(u) - P(epsilon)), where P = Pi - u and Pi is the integral
  // of the third kind of characteristic -N.
  int turn_axis_ = 2;      // whose projection across H is the hand of the turn
  Exact turn_rate_;        // [rad/s]
  Exact turn_factor_;      // [rad]
  Exact N_;                // in [0, 1]
  Exact turn_at_start_;    // P(epsilon)
  Exact turn_in_quarter_;  // P(K)
  Matrix dcm_NH_;          // of the momentum's frame at t = 0 to N

  Vector3d omega0_BN_B_;
  Quaterniond q0_BN_;
};

/// `attitude_deg`, the principal angle to the true attitude, and `rate_rad_s`.
std::vector<Deviation> torque_free_deviations(const Model& model,
                                              std::span<const Observation> samples);

}  // namespace twincraft
