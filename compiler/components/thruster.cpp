// See thruster.h. Tested by tests/compiler/propellant_test.cpp.
#include "compiler/components/thruster.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "compiler/ir/number.h"
#include "compiler/ir/propellant.h"

namespace twincraft {
namespace {

/// When nothing is left [s]. @pre that happens
double dry_at(const Tank& tank) {
  const auto& entries = tank.mass_flow.entries;
  double time = 0.0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double begin = std::max(entries[i].time, 0.0);
    const double left = tank.content_at(begin);
    const double end =
        i + 1 < entries.size() ? entries[i + 1].time : std::numeric_limits<double>::infinity();
    time = begin + left / entries[i].value;
    if (entries[i].value > 0.0 && time <= end) break;
  }
  return time;
}

}  // namespace

const Table<ThrusterSpec>& thruster_table() {
  static const Table<ThrusterSpec> table{
      "thruster",
      "A force fixed in the axes of its mount, fed from a tank.",
      {
          required("name", &ThrusterSpec::name, name(), "Unique in the file."),
          optional("mount", &ThrusterSpec::mount, reference_to("body"), "What it pushes."),
          optional("position", &ThrusterSpec::position, vector3("m"),
                   "Where the force acts, and where the propellant leaves the vehicle."),
          required("direction", &ThrusterSpec::direction, direction(),
                   "Of the force on the vehicle: against the exhaust."),
          required("thrust", &ThrusterSpec::thrust, schedule("N", Range::kNotNegative),
                   "Of the force."),
          optional("isp", &ThrusterSpec::isp, maybe(quantity("s", Range::kPositive)),
                   "Specific impulse: mdot = F / (9.80665 m/s2 Isp). Required with `tank`."),
          optional("tank", &ThrusterSpec::tank, maybe(reference_to("tank")),
                   "What it draws from; default none: thrust without depletion."),
          optional("during", &ThrusterSpec::during, maybe(intervals()),
                   "Half-open intervals [start, end) in which it burns; default always."),
      }};
  return table;
}

Schedule thrust_of(const ThrusterSpec& thruster) {
  return thruster.during ? thruster.thrust.during(*thruster.during) : thruster.thrust;
}

/// [kg/(N s)] @pre it has `isp`
static double flow_per_thrust(const ThrusterSpec& thruster) {
  return 1.0 / (kStandardGravity * thruster.isp.value());
}

/// Of one thruster [kg/s]. @pre it has `isp`
static Schedule mass_flow_of(const ThrusterSpec& thruster) {
  return thrust_of(thruster).scaled(flow_per_thrust(thruster));
}

Schedule mass_flow_of(const std::vector<ThrusterSpec>& thrusters, const std::string& tank) {
  Schedule flow;
  for (const ThrusterSpec& thruster : thrusters) {
    if (thruster.tank != tank) continue;
    flow = flow + mass_flow_of(thruster);
  }
  return flow;
}

Vector3d thrust_at_start(const std::vector<ThrusterSpec>& thrusters) {
  Vector3d sum = Vector3d::Zero();
  for (const ThrusterSpec& thruster : thrusters) {
    sum += thrust_of(thruster).at(0.0) * thruster.direction;
  }
  return sum;
}

void check(const ThrusterSpec& thruster, const Context& context, Diagnostics& diagnostics) {
  const std::string who = fmt::format("thruster `{}`", thruster.name);
  check_mount(thruster.mount, thruster.span_of("mount"), who, context.names, diagnostics);
  check_acts(thruster.during, thruster.span_of("during"), who, context, diagnostics);
  if (!thruster.tank) return;
  check_tank(*thruster.tank, thruster.span_of("tank"), who, context.names, diagnostics);
  if (thruster.isp) return;
  diagnostics
      .error(Code::kMissingKey, thruster.span(),
             fmt::format("{} draws from tank `{}` and has no `isp`", who, *thruster.tank))
      .with_note(thruster.span_of("tank"), "the mass flow is thrust / (g0 isp)");
}

void check_depletion(const TankSpec& spec, const std::vector<ThrusterSpec>& thrusters,
                     double duration, Diagnostics& diagnostics) {
  const Tank tank{spec.name, spec.propellant, mass_flow_of(thrusters, spec.name),
                  spec.depletion.momentum};
  const double left = tank.content_at(duration);
  if (left > 0.0) return;
  Diagnostic& error = diagnostics.error(
      Code::kOverDepletion, spec.span_of("propellant"),
      fmt::format("tank `{}` of {} kg runs dry at t = {:.6g} s: its thrusters take {:.6g} kg in "
                  "the {} s of the run",
                  spec.name, shortest(spec.propellant), dry_at(tank), spec.propellant - left,
                  shortest(duration)));
  error.with_hint("end the burn earlier with `during`");
  for (const ThrusterSpec& thruster : thrusters) {
    if (thruster.tank != spec.name) continue;
    error.with_note(thruster.span_of("thrust"),
                    fmt::format("thruster `{}` draws from it", thruster.name));
  }
}

void lower(const ThrusterSpec& spec, const Vehicle&, ModelBuilder& builder) {
  const Mount mount = builder.find_mount(spec.mount);
  Thruster thruster{thrust_of(spec), spec.direction};
  if (spec.tank) {
    thruster.tank = builder.find_tank(*spec.tank);
    thruster.flow_per_thrust = flow_per_thrust(spec);
    thruster.nozzle =
        builder.add_nozzle(mount, {spec.name, thruster.tank, 0, spec.position, mass_flow_of(spec)});
  }
  Load load;
  load.name = spec.name;
  load.r_FL_L = spec.position;
  for (int i = 0; i < 3; ++i) {
    // A component that is always zero makes no events.
    if (spec.direction[i] == 0.0) continue;
    load.force_M.at(static_cast<std::size_t>(i)) = thruster.thrust.scaled(spec.direction[i]);
  }
  load.thruster = std::move(thruster);
  builder.add_load(mount, std::move(load));
}

}  // namespace twincraft
