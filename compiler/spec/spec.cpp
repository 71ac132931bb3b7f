// The sections of a spec and what must hold between them. Tested by tests/compiler/spec_test.cpp.
#include "compiler/spec/spec.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/ir/number.h"

namespace twincraft {
namespace {

constexpr const char* kFormat = "spacecraft/1";

// A vehicle of this size takes a second or two to compile; a slip in a number of segments, or
// malice, would fill the memory.
constexpr int kMostCoordinates = 10'000;

constexpr const char* kExtendsDoc =
    "Another spec that this one starts from: a path from the folder of this file. Maps merge by "
    "key and lists of named members by `name`; other values and lists replace what they meet, and "
    "an explicit `null` takes an inherited key away. The file lies in the folder tree of the "
    "compiled spec: its folder and those below, or the tree of the nearest folder above that holds "
    "a file `.twincraft`. At most 16 files follow one another. The digest in a report is that of "
    "the texts of all files, the compiled one first.";

Names named_components(const Spec& spec, Diagnostics& diagnostics) {
  Names names;
  const auto add = [&](const auto& components, const char* what) {
    for (const auto& component : components) {
      names.add(component.name, what, component.span_of("name"), diagnostics);
    }
  };
  add(spec.wheels, "wheel");
  add(spec.panels, "panel");
  add(spec.bodies, "body");
  add(spec.tanks, "tank");
  for (const SloshSpec& slosh : spec.slosh) {
    const SloshCommon& own = common(slosh);
    names.add(own.name, "slosh mass", own.written.span_of("name"), diagnostics);
  }
  add(spec.thrusters, "thruster");
  add(spec.loads, "load");
  return names;
}

/// Joints and wheels, summed up to the first component with which they are too many.
struct Size {
  int coordinates = 0;
  std::optional<Span> too_many_at = {};

  void add(int count, Span span) {
    if (too_many_at) return;
    coordinates += count;
    if (coordinates > kMostCoordinates) too_many_at = span;
  }
};

Size size_of(const Spec& spec) {
  Size size;
  for (const WheelSpec& wheel : spec.wheels) size.add(1, wheel.span_of("name"));
  for (const PanelSpec& panel : spec.panels) size.add(panel.segments, panel.span_of("segments"));
  for (const BodySpec& body : spec.bodies) size.add(1, body.span_of("name"));
  for (const SloshSpec& slosh : spec.slosh)
    size.add(std::holds_alternative<PendulumSpec>(slosh) ? 2 : 1,
             common(slosh).written.span_of("name"));
  return size;
}

/// What is drawn from the tanks, and what sloshes in them, is there.
void check_tanks(const Spec& spec, Diagnostics& diagnostics) {
  for (const TankSpec& tank : spec.tanks) {
    check_content(tank, spec.slosh, diagnostics);
    check_depletion(tank, spec.thrusters, spec.simulation.duration, diagnostics);
  }
}

/// Of the vehicle at t = 0 [kg].
double total_mass(const Spec& spec) {
  double sum = spec.hub.mass;
  for (const WheelSpec& wheel : spec.wheels) sum += wheel.mass;
  for (const PanelSpec& panel : spec.panels) sum += panel.mass;
  for (const BodySpec& body : spec.bodies) sum += body.mass;
  for (const TankSpec& tank : spec.tanks) sum += tank.propellant;
  for (const SloshSpec& slosh : spec.slosh) sum += common(slosh).tank ? 0.0 : common(slosh).mass;
  return sum;
}

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

std::vector<Oscillator> oscillators(const Spec& spec) {
  std::vector<Oscillator> all;
  for (const PanelSpec& panel : spec.panels) {
    all.push_back({panel.name, fmt::format("panel `{}`", panel.name), segment_period(panel),
                   "no hinge of it has stiffness", panel.span_of("stiffness"),
                   fastest_decay(panel)});
  }
  const double acceleration = thrust_at_start(spec.thrusters).norm() / total_mass(spec);
  for (const SloshSpec& slosh : spec.slosh) all.push_back(oscillator(slosh, acceleration));
  return all;
}

bool names_stored(const Spec& spec) {
  return std::ranges::find(spec.references, ReferenceKind::kStored) != spec.references.end();
}

const Table<Spec>& spec_table() {
  static const Table<Spec> table{
      "spec",
      "One spacecraft, its surroundings, and the run that compares both engines on it. A plain "
      "number is in SI units; a text such as `12 deg` carries its unit. Quotes "
      "about either change nothing. Units are those of UDUNITS-2. Where its database rounds a "
      "multiple of the pound, the exact value holds: a slug is 1 lbf s2/ft. In SI units no "
      "quantity may exceed 1e30, and one that must be positive, other than a time, is at least "
      "1e-30: the engines form products of up to ten quantities, and a double ends at 1e-308 and "
      "1e308.",
      {
          required(
              "format", &Spec::format, text(),
              "The language's version: `spacecraft/1`. By convention the first key; the keys of a "
              "map have no order, so another place is no fault."),
          optional("extends", &Spec::extends, maybe(text()), kExtendsDoc),
          optional("drop", &Spec::drop, maybe(list_of(name())),
                   "Names of components of the extended spec to leave out. They are removed before "
                   "this spec's own are put in."),
          required("name", &Spec::name, name(), "Names the emitted files."),
          optional("description", &Spec::description, text(), "Free text."),
          required("hub", &Spec::hub, object(hub_table()), "The body that carries the rest."),
          optional("wheels", &Spec::wheels, list_of(object(wheel_table())), "Reaction wheels."),
          optional("panels", &Spec::panels, list_of(object(panel_table())), "Solar arrays."),
          optional("bodies", &Spec::bodies, list_of(object(body_table())),
                   "Rigid bodies on joints, in chains and branches."),
          optional("tanks", &Spec::tanks, list_of(object(tank_table())), "Propellant tanks."),
          optional("slosh", &Spec::slosh, list_of(slosh()), "Moving propellant."),
          optional("thrusters", &Spec::thrusters, list_of(object(thruster_table())),
                   "Thrust, and what it takes out of the tanks."),
          optional("loads", &Spec::loads, list_of(object(load_table())),
                   "External forces and torques."),
          optional("environment", &Spec::environment, object(environment_table()),
                   "Default: deep space."),
          optional("initial", &Spec::initial, object(initial_table()),
                   "Default: at rest at the origin of N."),
          optional("simulation", &Spec::simulation, object(simulation_table()),
                   "Integrator, step, duration."),
          optional("engines", &Spec::engines, object(engines_table()),
                   "Controls of the comparison."),
          optional("agreement", &Spec::agreement, object(agreement_table()),
                   "Tolerances of the verdict."),
          optional("references", &Spec::references, list_of(reference_kind()),
                   "Truths to compare each engine with: `kepler`, the two-body orbit; `spin_up`, a "
                   "rigid body under a constant torque about a principal axis; `torque_free`, a "
                   "rigid body that tumbles by itself; `tsiolkovsky`, the rocket equation; "
                   "`stored`, the states of the section `stored`. One that does not apply to the "
                   "vehicle is an error."),
          optional("stored", &Spec::stored, maybe(object(stored_table())),
                   "States computed elsewhere, for `references: [stored]`."),
          optional("study", &Spec::study, maybe(object(study_table())),
                   "Run many variants of this spec instead of one."),
      }};
  return table;
}

namespace {

/// Of a thruster or a load; the half-open run is [0, duration).
template <class Component>
void check_acts(const Component& component, std::string_view kind, double duration,
                Diagnostics& diagnostics) {
  if (!component.during) return;
  for (const Schedule::Interval& interval : *component.during)
    if (interval.start < duration && interval.end > 0.0) return;
  diagnostics.warning(Code::kNeverActs, component.span_of("during"),
                      fmt::format("{} `{}` does not act in the run, which is from 0 to {} s", kind,
                                  component.name, shortest(duration)));
}

}  // namespace

bool check_format(const Node& root, Diagnostics& diagnostics) {
  const Node* format = root.find("format");
  if (format == nullptr || !format->is_scalar() || format->scalar == kFormat) return true;
  diagnostics
      .error(Code::kUnsupportedFormat, format->span,
             fmt::format("format `{}` is not read by this program", format->scalar))
      .with_hint(fmt::format("it reads `{}`", kFormat));
  return false;
}

void check(const Spec& spec, Diagnostics& diagnostics) {
  const Size size = size_of(spec);
  if (size.too_many_at) {
    diagnostics
        .error(
            Code::kTooManyParts, *size.too_many_at,
            fmt::format("here the vehicle gets more than {} joints and wheels", kMostCoordinates))
        .with_hint("check the numbers of `segments`");
    return;
  }
  const Names names = named_components(spec, diagnostics);
  check(spec.hub, diagnostics);
  for (const WheelSpec& wheel : spec.wheels) check(wheel, names, diagnostics);
  for (const PanelSpec& panel : spec.panels) check(panel, names, diagnostics);
  for (const BodySpec& body : spec.bodies) check(body, names, diagnostics);
  check_circles(spec.bodies, diagnostics);
  for (const TankSpec& tank : spec.tanks) check(tank, names, diagnostics);
  for (const SloshSpec& slosh : spec.slosh) check(slosh, spec.tanks, names, diagnostics);
  for (const ThrusterSpec& thruster : spec.thrusters) check(thruster, names, diagnostics);
  for (const LoadSpec& load : spec.loads) check(load, names, diagnostics);
  if (!diagnostics.has_errors()) check_tanks(spec, diagnostics);
  check(spec.initial, spec.environment, diagnostics);
  check(spec.simulation, oscillators(spec), size.coordinates, diagnostics);
  check(spec.engines, spec.environment, diagnostics);
  check(spec.agreement, spec.references, diagnostics);
  if (spec.stored)
    check(*spec.stored, names_stored(spec), spec.environment, spec.simulation.duration,
          diagnostics);
  for (const ThrusterSpec& thruster : spec.thrusters)
    check_acts(thruster, "thruster", spec.simulation.duration, diagnostics);
  for (const LoadSpec& load : spec.loads)
    check_acts(load, "load", spec.simulation.duration, diagnostics);
  check_point_mass(spec, diagnostics);
  if (spec.study) members_of(*spec.study, diagnostics);
}

}  // namespace twincraft
