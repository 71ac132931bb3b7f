// Slosh of either sort: what a particle and a pendulum have in common, and how they are told apart.
// Tested by tests/compiler/slosh_test.cpp.
#pragma once

#include <variant>
#include <vector>

#include "compiler/components/slosh_pendulum.h"

namespace twincraft {

using SloshSpec = std::variant<PendulumSpec, ParticleSpec>;

/// Told apart by `type`.
Kind<SloshSpec> slosh();

const std::string& name_of(const SloshSpec& slosh);
const Written& written(const SloshSpec& slosh);

/// What both sorts have.
struct SloshCommon {
  const std::string& name;
  const std::optional<std::string>& tank;
  double mass;  // [kg]
  const Written& written;
};
SloshCommon common(const SloshSpec& slosh);

/// Of everything that names the tank [kg].
double slosh_mass_in(const std::string& tank, const std::vector<SloshSpec>& slosh);

void check(const SloshSpec& slosh, const Context& context, Diagnostics& diagnostics);

/// What sloshes in a tank is in it.
void check_content(const TankSpec& tank, const std::vector<SloshSpec>& slosh,
                   Diagnostics& diagnostics);

void lower(const SloshSpec& slosh, const Vehicle& vehicle, ModelBuilder& builder);

Coordinates coordinates_of(const SloshSpec& slosh);
/// What is in a tank is counted there.
double mass_of(const SloshSpec& slosh);
/// Pendulums swing under the acceleration that the thrusters give the vehicle at t = 0.
std::vector<Oscillator> oscillators_of(const std::vector<SloshSpec>& slosh, const Vehicle& vehicle);

}  // namespace twincraft
