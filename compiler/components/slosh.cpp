// See slosh.h. Tested by tests/compiler/slosh_test.cpp.
#include "compiler/components/slosh.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/components/physical.h"
#include "compiler/components/vehicle.h"
#include "compiler/ir/number.h"

namespace twincraft {
namespace {

bool is_pendulum(const Node& node) {
  const Node* type = node.is_map() ? node.find("type") : nullptr;
  return type != nullptr && type->is_scalar() && type->scalar == "pendulum";
}

const TankSpec* find_tank(const std::vector<TankSpec>& tanks,
                          const std::optional<std::string>& name) {
  const auto tank = std::find_if(tanks.begin(), tanks.end(),
                                 [&](const TankSpec& each) { return each.name == name; });
  return tank == tanks.end() ? nullptr : &*tank;
}

/// A tank elsewhere than on the slosh's mount leaves the position open.
void check_place(const SloshSpec& slosh, const TankSpec& tank, const std::string& who,
                 Diagnostics& diagnostics) {
  const auto [mount, has_position] =
      std::visit([](const auto& s) { return std::pair(s.mount, s.position.has_value()); }, slosh);
  if (has_position || !mount || *mount == tank.mount) return;
  diagnostics.error(Code::kMissingKey, common(slosh).written.span(),
                    fmt::format("{} is not mounted where its tank `{}` is, so it needs `position`",
                                who, tank.name));
}

/// @param acceleration  of the vehicle [m/s^2]
Oscillator oscillator(const SloshSpec& slosh, double acceleration) {
  if (const auto* pendulum = std::get_if<PendulumSpec>(&slosh)) {
    return {pendulum->name,
            fmt::format("pendulum `{}`", pendulum->name),
            period_of(*pendulum, acceleration),
            "no thruster burns at t = 0",
            pendulum->span(),
            pendulum->damping / pendulum->mass};
  }
  const auto& particle = std::get<ParticleSpec>(slosh);
  return {particle.name,
          fmt::format("particle `{}`", particle.name),
          period_of(particle),
          "it has no stiffness",
          particle.span_of("stiffness"),
          particle.damping / particle.mass};
}

}  // namespace

Kind<SloshSpec> slosh() {
  return either(is_pendulum, object(pendulum_table()), object(particle_table()));
}

SloshCommon common(const SloshSpec& slosh) {
  return std::visit([](const auto& s) { return SloshCommon{s.name, s.tank, s.mass, s}; }, slosh);
}

const std::string& name_of(const SloshSpec& slosh) { return common(slosh).name; }

const Written& written(const SloshSpec& slosh) { return common(slosh).written; }

double slosh_mass_in(const std::string& tank, const std::vector<SloshSpec>& slosh) {
  double sum = 0.0;
  for (const SloshSpec& each : slosh) {
    if (common(each).tank == tank) sum += common(each).mass;
  }
  return sum;
}

void check(const SloshSpec& slosh, const Context& context, Diagnostics& diagnostics) {
  const Names& names = context.names;
  const SloshCommon& own = common(slosh);
  const PendulumSpec* pendulum = std::get_if<PendulumSpec>(&slosh);
  const std::string who =
      fmt::format("{} `{}`", pendulum != nullptr ? "pendulum" : "particle", own.name);
  if (own.tank) check_tank(*own.tank, own.written.span_of("tank"), who, names, diagnostics);
  const TankSpec* tank = find_tank(context.vehicle.tanks, own.tank);
  const auto mount = std::visit([](const auto& s) { return s.mount; }, slosh);
  if (mount) check_mount(*mount, own.written.span_of("mount"), who, names, diagnostics);
  if (tank != nullptr) check_place(slosh, *tank, who, diagnostics);
  check_mass(own.mass, own.written.span_of("mass"), who, diagnostics);
  if (pendulum != nullptr) check_pendulum(*pendulum, who, diagnostics);
}

void check_content(const TankSpec& tank, const std::vector<SloshSpec>& slosh,
                   Diagnostics& diagnostics) {
  const double mass = slosh_mass_in(tank.name, slosh);
  if (mass <= tank.propellant) return;
  Diagnostic& error =
      diagnostics.error(Code::kSloshAboveContent, tank.span_of("propellant"),
                        fmt::format("{} kg slosh in tank `{}` of {} kg", shortest(mass), tank.name,
                                    shortest(tank.propellant)));
  error.with_hint("`propellant` is everything in the tank, slosh included");
  for (const SloshSpec& each : slosh) {
    const SloshCommon& part = common(each);
    if (part.tank != tank.name) continue;
    error.with_note(part.written.span_of("mass"),
                    fmt::format("`{}` has {} kg", part.name, shortest(part.mass)));
  }
}

void lower(const SloshSpec& slosh, const Vehicle& vehicle, ModelBuilder& builder) {
  const TankSpec* tank = find_tank(vehicle.tanks, common(slosh).tank);
  std::visit([&](const auto& s) { lower(s, tank, builder); }, slosh);
}

Coordinates coordinates_of(const SloshSpec& slosh) {
  return {std::holds_alternative<PendulumSpec>(slosh) ? 2 : 1, written(slosh).span_of("name")};
}

double mass_of(const SloshSpec& slosh) { return common(slosh).tank ? 0.0 : common(slosh).mass; }

std::vector<Oscillator> oscillators_of(const std::vector<SloshSpec>& slosh,
                                       const Vehicle& vehicle) {
  const double acceleration = thrust_at_start(vehicle.thrusters).norm() / total_mass(vehicle);
  std::vector<Oscillator> all;
  for (const SloshSpec& each : slosh) all.push_back(oscillator(each, acceleration));
  return all;
}

}  // namespace twincraft
