// What an engine shows of itself at one instant: physical quantities that mean the same in either
// engine, whatever its state vector looks like. All comparison happens on these.
#pragma once

#include <vector>

#include "compiler/ir/mass.h"

namespace twincraft {

struct Observation {
  double time = 0.0;                   // [s]
  Vector3d r_BN_N, v_BN_N;             // hub origin [m], [m/s]
  Quaterniond q_BN;                    // B to N components, scalar not negative
  Vector3d omega_BN_B;                 // [rad/s]
  Vector3d r_CN_N, v_CN_N;             // system centre of mass
  std::vector<double> joint_position;  // [rad] or [m], one per link but the hub
  std::vector<double> joint_rate;
  std::vector<double> wheel_rate;  // [rad/s] relative to the mount
  double mass = 0.0;               // [kg]

  // The books of conservation, of the engine's own masses.
  double kinetic = 0.0;    // [J] in N
  double potential = 0.0;  // [J] springs; gravity as -sum mu m/r (system_com: of all mass at C)
  // The vehicle's own motion: what an orbit does not hide.
  double own_kinetic = 0.0;  // [J] about C
  double springs = 0.0;      // [J]
  Vector3d momentum;         // [kg m/s] in N
  Vector3d H_PntC_N;         // [kg m^2/s] angular momentum about C
  // Sums of the magnitudes of what is added up (momentum: of the hub origin's velocity and of each
  // body's beyond it): what "relative" means for a total near zero.
  double momentum_scale = 0.0;
  double H_scale = 0.0;
};

/// Rates of what changes the books from outside; integrated beside the state when asked for.
struct ExternalRates {
  double power = 0.0;  // [W] efforts, motors, loads, gradient torques, minus damping
  Vector3d force_N = Vector3d::Zero();        // [N] gravity included
  Vector3d torque_PntC_N = Vector3d::Zero();  // [N m] about C
  double own_power = 0.0;  // [W] what works on the own motion: gravity's differences included
};

}  // namespace twincraft
