// See slosh_particle.h. Tested by tests/compiler/slosh_test.cpp.
#include "compiler/components/slosh_particle.h"

#include <cmath>
#include <numbers>

namespace twincraft {
const Table<ParticleSpec>& particle_table() {
  static const Table<ParticleSpec> table{
      "particle",
      "A slosh mass that slides along a line, on a spring and a damper.",
      {
          required("name", &ParticleSpec::name, name(), "Unique in the file."),
          required("type", &ParticleSpec::type,
                   one_of<SloshType>(
                       {{"particle", SloshType::kParticle}, {"pendulum", SloshType::kPendulum}}),
                   "`particle`; a `pendulum` has keys of its own."),
          optional("mount", &ParticleSpec::mount, maybe(reference_to("body")),
                   "What carries it; default the tank's mount, else the hub."),
          optional("tank", &ParticleSpec::tank, maybe(reference_to("tank")),
                   "The tank it is part of and depletes with."),
          required("mass", &ParticleSpec::mass, quantity("kg", Range::kPositive),
                   "At t = 0, part of the tank's propellant."),
          required("axis", &ParticleSpec::axis, direction(), "Of the line, in the mount's axes."),
          optional("position", &ParticleSpec::position, maybe(vector3("m")),
                   "Where the spring is at rest; default the tank's centre, else the mount's "
                   "origin."),
          optional("stiffness", &ParticleSpec::stiffness, quantity("N/m", Range::kNotNegative),
                   "Of the spring; it stays as it is when the tank drains."),
          optional("damping", &ParticleSpec::damping, quantity("N s/m", Range::kNotNegative),
                   "Of the damper; it stays as it is when the tank drains."),
          optional("displacement", &ParticleSpec::displacement, quantity("m"), "Initial."),
          optional("rate", &ParticleSpec::rate, quantity("m/s"), "Initial."),
      }};
  return table;
}

std::optional<double> period_of(const ParticleSpec& particle) {
  if (!(particle.stiffness > 0.0)) return std::nullopt;
  return 2.0 * std::numbers::pi * std::sqrt(particle.mass / particle.stiffness);
}

void lower(const ParticleSpec& spec, const TankSpec* tank, ModelBuilder& builder) {
  Joint slide;
  slide.kind = JointKind::kSlide;
  slide.r_HP_P = position_with(tank, spec.position);
  slide.axis_L = spec.axis;
  slide.stiffness = spec.stiffness;
  slide.damping = spec.damping;
  const Mount mount =
      builder.add_link(builder.find_mount(mount_with(tank, spec.mount)), spec.name, slide);
  MassElement point;
  point.name = spec.name;
  point.mass = spec.mass;
  point.tank = tank == nullptr ? -1 : builder.find_tank(tank->name);
  builder.add_mass(mount, point);
  builder.draw(mount, {.form = Look::Form::kSphere, .part = Look::Part::kSlosh});
  builder.add_token_inertia(mount, builder.controls().particle_inertia);
  builder.add_coordinate(Coordinate::Kind::kParticle, spec.name, mount.link, spec.displacement,
                         spec.rate);
}

}  // namespace twincraft
