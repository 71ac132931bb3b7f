// The controls of the comparison. The defaults make both engines the same machine to rounding; the
// others reproduce on purpose what makes them differ. Tested by tests/compiler/engines_test.cpp.
#pragma once

#include <optional>

#include "compiler/spec/environment.h"

namespace twincraft {

struct BsmSpec : Written {
  AttitudeChart attitude = AttitudeChart::kMrp;
  ChainPath chains = ChainPath::kPlanar;
  std::optional<GravityLaw> gravity;  // absent: the environment's
};

struct MujocoSpec : Written {
  MujocoFrame frame = MujocoFrame::kComoving;
  double wheel_mass = 1.0e-6;     // [kg] token mass of a massless wheel
  double bob_inertia = 0.0;       // [kg m^2] token inertia of a pendulum's bob
  double particle_inertia = 0.0;  // [kg m^2] token inertia of a slosh particle
  bool compensate = true;
  std::optional<GravityLaw> gravity;  // absent: the environment's
};

struct EnginesSpec : Written {
  BsmSpec bsm;
  MujocoSpec mujoco;
};

const Table<EnginesSpec>& engines_table();

/// A law of gravity needs gravity; a token mass must be one that MuJoCo loads.
void check(const EnginesSpec& engines, const EnvironmentSpec& environment,
           Diagnostics& diagnostics);

EngineControls lower(const EnginesSpec& engines);

/// The field and the law by which each engine applies it.
Gravity lower_gravity(const EnvironmentSpec& environment, const EnginesSpec& engines);

}  // namespace twincraft
