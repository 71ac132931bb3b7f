// What the analytic engine reports of itself: momenta, energies, and the mass matrix for proofs.
// Nothing here runs inside a step. Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include "runtime/bsm/motion.h"
#include "runtime/engine/observation.h"
#include "runtime/forces/elements.h"

namespace twincraft::bsm {

/// The system's centre of mass, in hub axes.
struct Center {
  double mass = 0.0;                   // [kg]
  Vector3d r_CB_B = Vector3d::Zero();  // [m]
  Vector3d v_CB_B = Vector3d::Zero();  // [m/s] with the velocity of B taken as zero
};
Center center_of(const Tree& tree, const Motion& motion);

/// Sums over all mass elements and rotors, in hub axes, with the velocity of B taken as zero.
struct Totals : Center {
  Vector3d H_PntC_B = Vector3d::Zero();        // [kg m^2/s] about C
  double kinetic = 0.0;                        // [J] about C: without m v_C^2 / 2
  double momentum_scale = 0.0, H_scale = 0.0;  // sums of magnitudes
};

Totals sum_up(const Motion& motion, const Elements& elements, const Tree& tree,
              std::span<const double> rotor_speed);

/// What leaves the books because mass leaves the vehicle: their rates at fixed motion. The velocity
/// of B is taken as zero here too.
struct Leaving {
  double mass = 0.0;                       // [kg/s]
  Vector3d momentum_B = Vector3d::Zero();  // [N] relative to B
  Vector3d H_PntC_B = Vector3d::Zero();    // [N m] about C
  double kinetic = 0.0;                    // [W] relative to B
};

/// @param share_rates  of every tank [1/s]  @param center  of the same motion
Leaving sum_up_leaving(const Motion& motion, const Tree& tree, std::span<const double> share_rates,
                       const Center& center);

/// Centre of mass, momenta and kinetic energy in N; needs o.r_BN_N and o.v_BN_N.
void fill_books(const Totals& totals, const Matrix3d& dcm_NB, Observation& o);

double spring_energy(const Tree& tree, std::span<const double> q);  // [J]
/// Efforts less what the dampers take [W].
double joint_power(const Tree& tree, std::span<const double> q, std::span<const double> q_dot,
                   std::span<const double> effort);
double motor_power(std::span<const double> rotor_speed, std::span<const double> torque);  // [W]

/// Over (v_B in N, omega in B, qDot, wheel speeds), summed from partial velocities.
Eigen::MatrixXd dense_mass_matrix(const Tree& tree, const Motion& motion, const Matrix3d& dcm_NB);

}  // namespace twincraft::bsm
