// A slosh particle: a point mass that slides along a line fixed in its mount, on a spring and a
// damper: m rhoDDot = -k rho - c rhoDot plus what the mount's motion does.
// Tested by tests/compiler/slosh_test.cpp.
#pragma once

#include <optional>

#include "compiler/components/tank.h"

namespace twincraft {

/// The two sorts of slosh, told apart by `type`.
enum class SloshType { kParticle, kPendulum };

struct ParticleSpec : Written {
  std::string name;
  SloshType type = SloshType::kParticle;
  std::optional<std::string> mount;   // absent: the tank's, else hub
  std::optional<std::string> tank;    // depletes with it
  double mass = 0.0;                  // [kg]
  Vector3d axis = Vector3d::UnitZ();  // unit, mount axes
  std::optional<Vector3d> position;   // [m] rest, mount axes; absent: the tank's centre
  double stiffness = 0.0;             // k [N/m]
  double damping = 0.0;               // c [N s/m]
  double displacement = 0.0;          // [m] initial
  double rate = 0.0;                  // [m/s] initial
};

const Table<ParticleSpec>& particle_table();

/// 2 pi sqrt(m/k) [s]; nothing without a spring.
std::optional<double> period_of(const ParticleSpec& particle);

/// One slide coordinate `NAME`. @param tank  what it depletes with; null: nothing
void lower(const ParticleSpec& particle, const TankSpec* tank, ModelBuilder& builder);

}  // namespace twincraft
