// The rocket equation: thrust along a fixed line through the centre of mass, a mass that falls
// linearly between events,
//   dv = F/mdot ln(m0/m1),   dr = v0 t + F/mdot (t - m1/mdot ln(m0/m1)),
// phase after phase.  Tested by tests/runtime/reference_test.cpp.
#pragma once

#include "runtime/reference/reference.h"

namespace twincraft {

class Rocket {
 public:
  /// @pre tsiolkovsky applies to `model`
  explicit Rocket(const Model& model);

  /// What thrust adds to a coasting hub since t = 0, in B components: the hub does not turn.
  struct Gain {
    Vector3d velocity = Vector3d::Zero();  // [m/s]
    Vector3d position = Vector3d::Zero();  // [m] beyond v0 t
  };
  Gain at(double time) const;

 private:
  /// Between two events.
  struct Phase {
    double start = 0.0;                   // [s]
    double mass = 0.0;                    // [kg] at its start
    double flow = 0.0;                    // [kg/s] out of the vehicle
    Vector3d force_B = Vector3d::Zero();  // [N]
    Gain before;                          // at its start
  };
  static Gain after(const Phase& phase, double time);

  std::vector<Phase> phases_;
};

/// `velocity_m_s` of the system centre of mass, `position_m` of the hub origin, and
/// `delta_v_relative`, the first as a part of what was gained until then.
std::vector<Deviation> tsiolkovsky_deviations(const Model& model,
                                              std::span<const Observation> samples);

}  // namespace twincraft
