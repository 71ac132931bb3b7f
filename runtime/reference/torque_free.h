// A rigid body that nothing turns from outside: Euler's top. Its rates are Jacobi's elliptic
// functions of time; its attitude adds an elliptic integral of the third kind, the turn about the
// angular momentum that stays where it is. Exact at any time, without steps.
// Tested by tests/runtime/reference_test.cpp.
#pragma once

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
  using Real = long double;
  using Vector = Eigen::Matrix<Real, 3, 1>;
  using Matrix = Eigen::Matrix<Real, 3, 3>;

  /// Of the argument u = wp t + epsilon: the elliptic functions, and the integral of
  /// 1/(1 - n sn^2) from 0.
  struct Elliptic {
    Real sn, cn, dn, third;
  };

  void order_axes(const Matrix3d& I_PntC_B, const Vector3d& omega_BN_B);
  void find_amplitudes(const Vector& omega);
  Elliptic elliptic(Real u) const;
  Vector rates(const Elliptic& at) const;
  Matrix momentum_frame(const Vector& omega) const;
  State steady(double time) const;

  // Principal axes P as columns in B components, so ordered that 2 has the middle moment and the
  // rate about 3 never vanishes; right-handed.
  Matrix dcm_BP_;
  Vector moments_;          // [kg m^2] about 1, 2, 3
  Vector amplitudes_;       // [rad/s], signs included
  bool is_steady_ = false;  // the rates stay as they are
  Real modulus_ = 0.0L;     // k
  Real quarter_ = 0.0L;     // K(k)
  Real third_ = 0.0L;       // the complete integral of the third kind
  Real n_ = 0.0L;           // its characteristic, never positive
  Real frequency_ = 0.0L;   // wp [rad/s]
  Real phase_ = 0.0L;       // epsilon
  Real momentum_ = 0.0L;    // |H| [N m s]
  Real third_at_start_ = 0.0L;
  Matrix dcm_NH_;  // of the momentum's frame at t = 0 to N
  Vector3d omega0_BN_B_;
  Quaterniond q0_BN_;
};

/// `attitude_deg`, the principal angle to the true attitude, and `rate_rad_s`.
std::vector<Deviation> torque_free_deviations(const Model& model,
                                              std::span<const Observation> samples);

}  // namespace twincraft
