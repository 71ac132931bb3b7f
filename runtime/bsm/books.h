// What the analytic engine reports of itself: momenta, energies, and the mass matrix for proofs.
// Nothing here runs inside a step. Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include "runtime/bsm/motion.h"
#include "runtime/engine/observation.h"
#include "runtime/forces/elements.h"

namespace twincraft::bsm {

/// Sums over all mass elements and rotors, in hub axes, with the velocity of B taken as zero.
struct Totals {
  double mass = 0.0;                           // [kg]
  Vector3d r_CB_B = Vector3d::Zero();          // [m]
  Vector3d v_CB_B = Vector3d::Zero();          // [m/s]
  Vector3d H_PntC_B = Vector3d::Zero();        // [kg m^2/s] about C
  double kinetic = 0.0;                        // [J] about C: without m v_C^2 / 2
  double momentum_scale = 0.0, H_scale = 0.0;  // sums of magnitudes
};

/// How an element moves, with the velocity of B taken as zero.
struct MovingElement {
  double mass;
  Vector3d r_EB, v_E, spin;  // [m], [m/s], [kg m^2/s] angular momentum about its own centre
  double spin_energy;        // [J]
};

/// @param all  receives the elements; its memory serves again
Totals sum_up(const Motion& motion, const Elements& elements, const Tree& tree,
              std::span<const double> rotor_speed, std::vector<MovingElement>& all);

/// Centre of mass, momenta and kinetic energy in N; needs o.r_BN_N and o.v_BN_N.
void fill_books(const Totals& totals, const Matrix3d& dcm_NB, Observation& o);

double spring_energy(const Tree& tree, std::span<const double> q);  // [J]

/// Over (v_B in N, omega in B, qDot, wheel speeds), summed from partial velocities.
Eigen::MatrixXd dense_mass_matrix(const Tree& tree, const Motion& motion, const Matrix3d& dcm_NB);

}  // namespace twincraft::bsm
