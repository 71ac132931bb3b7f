// See tank.h. Tested by tests/compiler/propellant_test.cpp.
#include "compiler/components/tank.h"

#include <fmt/format.h>

#include <numbers>

#include "compiler/components/physical.h"
#include "compiler/components/vehicle.h"
#include "compiler/ir/number.h"
#include "compiler/ir/rotation.h"

namespace twincraft {
namespace {

const Table<SphereSpec>& sphere_table() {
  static const Table<SphereSpec> table{
      "sphere",
      "A spherical tank.",
      {
          required("radius", &SphereSpec::radius, quantity("m", Range::kPositive), "Inside."),
      }};
  return table;
}

const Table<CylinderSpec>& cylinder_table() {
  static const Table<CylinderSpec> table{
      "cylinder",
      "A cylindrical tank with flat ends.",
      {
          required("radius", &CylinderSpec::radius, quantity("m", Range::kPositive), "Inside."),
          required("length", &CylinderSpec::length, quantity("m", Range::kPositive), "Inside."),
          required("axis", &CylinderSpec::axis, direction(), "Of symmetry, in the mount's axes."),
      }};
  return table;
}

const Table<TankShapeSpec>& shape_table() {
  static const Table<TankShapeSpec> table = Table<TankShapeSpec>{
      "tank shape",
      "The solid whose inertia the bulk of the propellant has.",
      {
          optional("sphere", &TankShapeSpec::sphere, maybe(object(sphere_table())),
                   "2/5 m R^2 about every axis."),
          optional("cylinder", &TankShapeSpec::cylinder, maybe(object(cylinder_table())),
                   "m R^2 / 2 along its axis, m (3 R^2 + L^2) / 12 across."),
      }}.exactly_one_of({"sphere", "cylinder"});
  return table;
}

const Table<DepletionSpec>& depletion_table() {
  static const Table<DepletionSpec> table{
      "depletion",
      "What propellant takes along when it leaves, besides the thrust. The bulk and every slosh "
      "mass of the tank are its sources. With `none` a source loses mass where it is, with the "
      "velocity it has there: the vehicle moves at every instant as one of constant masses, those "
      "of that instant, and no transport term acts. With `jet` propellant flows in a straight line "
      "from the centre of each source to the `position` of the thruster and leaves with the "
      "velocity of that point, whatever bodies the two are on. The flow is steady: the mass in the "
      "line, its acceleration, and the kick when the flow starts or stops are neglected.",
      {
          optional("momentum", &DepletionSpec::momentum,
                   one_of<LeavingMomentum>(
                       {{"none", LeavingMomentum::kNone}, {"jet", LeavingMomentum::kJet}}),
                   "`none`: nothing, so there is no jet damping. `jet`: the momentum and angular "
                   "momentum it has at the nozzle, which damps the rates of the vehicle."),
      }};
  return table;
}

Look look_of(const TankShapeSpec& shape) {
  Look look;
  look.part = Look::Part::kTank;
  if (shape.sphere) {
    look.form = Look::Form::kSphere;
    look.half.x() = shape.sphere->radius;
  } else if (shape.cylinder) {
    look.form = Look::Form::kCylinder;
    look.half = Vector3d(shape.cylinder->radius, shape.cylinder->length / 2.0, 0.0);
    look.quat = shortest_rotation(Vector3d::UnitZ(), shape.cylinder->axis);
  }
  return look;
}

}  // namespace

const Table<TankSpec>& tank_table() {
  static const Table<TankSpec> table{
      "tank",
      "A propellant tank: a fixed bulk, and the slosh masses that name it.",
      {
          required("name", &TankSpec::name, name(), "Unique in the file."),
          optional("mount", &TankSpec::mount, reference_to("body"), "What carries the tank."),
          optional("position", &TankSpec::position, vector3("m"), "Of its centre."),
          required("shape", &TankSpec::shape, object(shape_table()), "Sphere or cylinder."),
          required("propellant", &TankSpec::propellant, quantity("kg", Range::kPositive),
                   "Everything in it at t = 0, slosh included; the rest is the bulk."),
          optional("density", &TankSpec::density, maybe(quantity("kg/m3", Range::kPositive)),
                   "Of the propellant. With it, more than the tank holds is refused."),
          optional(
              "depletion", &TankSpec::depletion, object(depletion_table()),
              "What leaves takes no angular momentum along, unless this says `{momentum: jet}`."),
      }};
  return table;
}

double volume(const TankShapeSpec& shape) {
  if (shape.sphere) {
    const double R = shape.sphere->radius;
    return 4.0 / 3.0 * std::numbers::pi * R * R * R;
  }
  const CylinderSpec& cylinder = shape.cylinder.value();
  return std::numbers::pi * cylinder.radius * cylinder.radius * cylinder.length;
}

Matrix3d solid_inertia(const TankShapeSpec& shape, double mass) {
  if (shape.sphere) {
    const double R = shape.sphere->radius;
    return 0.4 * mass * R * R * Matrix3d::Identity();
  }
  const CylinderSpec& cylinder = shape.cylinder.value();
  const double R2 = cylinder.radius * cylinder.radius;
  const double along = 0.5 * mass * R2;
  const double across = mass * (3.0 * R2 + cylinder.length * cylinder.length) / 12.0;
  return across * Matrix3d::Identity() +
         (along - across) * cylinder.axis * cylinder.axis.transpose();
}

std::string mount_with(const TankSpec* tank, const std::optional<std::string>& mount) {
  return mount.value_or(tank != nullptr ? tank->mount : "hub");
}

Vector3d position_with(const TankSpec* tank, const std::optional<Vector3d>& position) {
  return position.value_or(tank != nullptr ? tank->position : Vector3d::Zero());
}

void check(const TankSpec& tank, const Context& context, Diagnostics& diagnostics) {
  const std::string who = fmt::format("tank `{}`", tank.name);
  check_mount(tank.mount, tank.span_of("mount"), who, context.names, diagnostics);
  check_mass(tank.propellant, tank.span_of("propellant"), who, diagnostics);
  if (!tank.density) return;
  const double most = *tank.density * volume(tank.shape);
  if (tank.propellant <= most) return;
  diagnostics
      .error(Code::kTankOverfilled, tank.span_of("propellant"),
             fmt::format("{} kg of propellant do not fit into {}, which holds {:.6g} kg",
                         shortest(tank.propellant), who, most))
      .with_note(tank.span_of("shape"), fmt::format("{:.6g} m3", volume(tank.shape)))
      .with_note(tank.span_of("density"), fmt::format("{} kg/m3", shortest(*tank.density)));
}

void check_together(const std::vector<TankSpec>& tanks, const Context& context,
                    Diagnostics& diagnostics) {
  if (diagnostics.has_errors()) return;
  for (const TankSpec& tank : tanks) {
    check_content(tank, context.vehicle.slosh, diagnostics);
    check_depletion(tank, context.vehicle.thrusters, context.duration, diagnostics);
  }
}

double mass_of(const TankSpec& tank) { return tank.propellant; }

void lower(const TankSpec& spec, const Vehicle& vehicle, ModelBuilder& builder) {
  const int tank =
      builder.add_tank({spec.name, spec.propellant, mass_flow_of(vehicle.thrusters, spec.name),
                        spec.depletion.momentum});
  const double bulk = spec.propellant - slosh_mass_in(spec.name, vehicle.slosh);
  if (!(bulk > kMujocoMinimum)) return;  // all of it sloshes
  // A body of its own, so that nothing else of the mount changes when it drains.
  const Mount mount = builder.add_fixed_body(builder.find_mount(spec.mount), spec.name,
                                             spec.position, Matrix3d::Identity());
  builder.add_mass(mount,
                   {spec.name, bulk, Vector3d::Zero(), solid_inertia(spec.shape, bulk), tank});
  builder.draw(mount, look_of(spec.shape));
}

}  // namespace twincraft
