// See slosh_pendulum.h. Tested by tests/compiler/slosh_test.cpp.
#include "compiler/components/slosh_pendulum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/ir/angle.h"

namespace twincraft {
namespace {

// How far from a right angle rest and reference may be, as the sine.
constexpr double kPerpendicularTolerance = 1.0e-9;

// Least |cos theta| at the start.
constexpr double kLeastCosine = 1.0e-3;

Kind<std::vector<double>> two(SiUnit unit) { return quantities(unit, 2); }

/// p1, p2, p3 in mount axes. `rest` is kept; `reference` is made exactly perpendicular to it.
Matrix3d pivot_axes(const PendulumSpec& pendulum) {
  const Vector3d p3 = pendulum.rest.cross(pendulum.reference).normalized();
  Matrix3d dcm;
  dcm << pendulum.rest, p3.cross(pendulum.rest), p3;
  return dcm;
}

}  // namespace

const Table<PendulumSpec>& pendulum_table() {
  static const Table<PendulumSpec> table{
      "pendulum",
      "A slosh mass on a spherical pendulum with two angles: phi about rest x reference, then "
      "theta "
      "about the turned reference.",
      {
          required("name", &PendulumSpec::name, name(), "Unique in the file."),
          required("type", &PendulumSpec::type,
                   one_of<SloshType>({{"pendulum", SloshType::kPendulum}}),
                   "`pendulum`; a `particle` has keys of its own."),
          optional("mount", &PendulumSpec::mount, maybe(reference_to("body")),
                   "What carries it; default the tank's mount, else the hub."),
          optional("tank", &PendulumSpec::tank, maybe(reference_to("tank")),
                   "The tank it is part of and depletes with."),
          required("mass", &PendulumSpec::mass, quantity("kg", Range::kPositive),
                   "Of the bob at t = 0, part of the tank's propellant."),
          required("length", &PendulumSpec::length, quantity("m", Range::kPositive),
                   "From pivot to bob."),
          required("rest", &PendulumSpec::rest, direction(),
                   "From pivot to bob at zero angles, in the mount's axes."),
          required("reference", &PendulumSpec::reference, direction(),
                   "The axis theta turns about at phi = 0; perpendicular to `rest`."),
          optional("position", &PendulumSpec::position, maybe(vector3("m")),
                   "Of the pivot; default the tank's centre, else the mount's origin."),
          optional("angles", &PendulumSpec::angles, two("rad"), "Initial phi and theta."),
          optional("rates", &PendulumSpec::rates, two("rad/s"), "Their initial rates."),
          optional("damping", &PendulumSpec::damping, quantity("N s/m", Range::kNotNegative),
                   "Linear drag D on the bob: torques -D L^2 cos^2 theta phiDot and -D L^2 "
                   "thetaDot. D stays as it is when the tank drains."),
          optional("inertia", &PendulumSpec::inertia, quantity("kg m2", Range::kNotNegative),
                   "Of the bob about its centre, the same about every axis. 0: a point mass. It "
                   "scales with the bob's mass."),
      }};
  return table;
}

std::optional<double> period_of(const PendulumSpec& pendulum, double acceleration) {
  if (!(acceleration > 0.0)) return std::nullopt;
  return 2.0 * std::numbers::pi * std::sqrt(pendulum.length / acceleration);
}

void check_pendulum(const PendulumSpec& pendulum, const std::string& who,
                    Diagnostics& diagnostics) {
  const double cosine = pendulum.rest.dot(pendulum.reference);
  if (std::abs(cosine) > kPerpendicularTolerance) {
    diagnostics
        .error(Code::kNotPerpendicular, pendulum.span_of("reference"),
               fmt::format("`reference` and `rest` of {} are off perpendicular by {:.3g} degrees",
                           who, std::asin(std::min(std::abs(cosine), 1.0)) * kDegrees))
        .with_note(pendulum.span_of("rest"), "`rest` is written here");
  }
  const double theta = pendulum.angles.at(1);
  if (std::abs(std::cos(theta)) >= kLeastCosine) return;
  diagnostics
      .error(Code::kPendulumSingular, pendulum.span_of("angles"),
             fmt::format("theta of {} starts at {:.6g} degrees, where phi means nothing", who,
                         theta * kDegrees))
      .with_hint("choose another `reference`, so that the bob swings in phi");
}

void lower(const PendulumSpec& spec, const TankSpec* tank, ModelBuilder& builder) {
  Joint phi;
  phi.r_HP_P = position_with(tank, spec.position);
  phi.dcm_PL0 = pivot_axes(spec);
  phi.axis_L = Vector3d::UnitZ();
  phi.damping = spec.damping * spec.length * spec.length;
  Joint theta;
  theta.axis_L = Vector3d::UnitY();
  theta.damping = phi.damping;
  const Mount mount = builder.find_mount(mount_with(tank, spec.mount));
  const auto [phi_link, bob] = builder.add_pendulum(mount, spec.name, phi, theta);

  MassElement element;
  element.name = spec.name;
  element.mass = spec.mass;
  element.r_EL_L = Vector3d(spec.length, 0.0, 0.0);
  element.I_PntE_L = spec.inertia * Matrix3d::Identity();
  element.tank = tank == nullptr ? -1 : builder.find_tank(tank->name);
  builder.add_mass(bob, element);
  builder.draw(bob,
               {.form = Look::Form::kSphere, .part = Look::Part::kSlosh, .pos = element.r_EL_L});
  builder.add_token_inertia(bob, builder.controls().bob_inertia);
  builder.add_coordinate(Coordinate::Kind::kPendulum, spec.name + ".phi", phi_link,
                         spec.angles.at(0), spec.rates.at(0));
  builder.add_coordinate(Coordinate::Kind::kPendulum, spec.name + ".theta", bob.link,
                         spec.angles.at(1), spec.rates.at(1));
}

}  // namespace twincraft
