// What an engine shows of itself at one instant: physical quantities that mean the same in either
// engine, whatever its state vector looks like. All comparison happens on these.
#pragma once

#include <cstddef>
#include <span>

#include "compiler/ir/signals.h"

namespace twincraft {

/// The scalar of q_BN is not negative.
struct Observation : VehicleState {
  double time = 0.0;                   // [s]
  Vector3d r_CN_N = Vector3d::Zero();  // system centre of mass [m]
  Vector3d v_CN_N = Vector3d::Zero();  // [m/s]
  double mass = 0.0;                   // [kg]

  // The books of conservation, of the engine's own masses.
  double kinetic = 0.0;    // [J] in N
  double potential = 0.0;  // [J] springs; gravity as -sum mu m/r (system_com: of all mass at C)
  // The vehicle's own motion: what an orbit does not hide.
  double own_kinetic = 0.0;              // [J] about C
  double springs = 0.0;                  // [J]
  Vector3d momentum = Vector3d::Zero();  // [kg m/s] in N
  Vector3d H_PntC_N = Vector3d::Zero();  // [kg m^2/s] angular momentum about C
  // Sums of the magnitudes of what is added up (momentum: of the hub origin's velocity and of each
  // body's beyond it): what "relative" means for a total near zero.
  double momentum_scale = 0.0;
  double H_scale = 0.0;
};

/// @pre not of a wheel, whose angle nobody knows
inline double position_of(const Coordinate& coordinate, const Observation& seen) {
  return seen.joint_position[coordinate.entry()];
}
inline double rate_of(const Coordinate& coordinate, const Observation& seen) {
  return (coordinate.is_wheel() ? seen.wheel_rate : seen.joint_rate)[coordinate.entry()];
}
/// One number of an output: the only place that knows where it is.
double value_of(const OutputSignal& output, std::size_t component, const Observation& seen);
/// The same, to be written; it stays where it is as long as no coordinate is added to `seen`.
double& place_of(const OutputSignal& output, std::size_t component, Observation& seen);
/// Let a state have these numbers of an output. An attitude need not be normalised.
/// @pre it is one of motion_of()
void set_value(const OutputSignal& output, std::span<const double> numbers, VehicleState& state);

/// Rates of what changes the books from outside; integrated beside the state in a recorded run.
struct BookRates {
  double power = 0.0;  // [W] efforts, motors, loads, gradient torques, minus damping
  Vector3d force_N = Vector3d::Zero();        // [N] gravity included
  Vector3d torque_PntC_N = Vector3d::Zero();  // [N m] about C
  double own_power = 0.0;  // [W] what works on the own motion: gravity's differences included
};

}  // namespace twincraft
