// The sections of a spec and what must hold between them. Tested by tests/compiler/spec_test.cpp.
#include "compiler/components/spec.h"

#include <fmt/format.h>

namespace twincraft {
namespace {

constexpr const char* kFormat = "spacecraft/1";

Names named_components(const Spec& spec, Diagnostics& diagnostics) {
  Names names;
  const auto add = [&](const auto& components, const char* what) {
    for (const auto& component : components) {
      names.add(component.name, what, component.span_of("name"), diagnostics);
    }
  };
  add(spec.wheels, "wheel");
  add(spec.panels, "panel");
  add(spec.loads, "load");
  return names;
}

void check_references(const Spec& spec, Diagnostics& diagnostics) {
  const bool is_rigid = spec.wheels.empty() && spec.panels.empty();
  for (std::size_t i = 0; i < spec.references.size(); ++i) {
    const Span span = spec.node->find("references")->items[i].span;
    check_reference(spec.references[i], span, spec.environment, is_rigid, diagnostics);
  }
}

}  // namespace

const Table<Spec>& spec_table() {
  static const Table<Spec> table{
      "spec",
      "One spacecraft, its surroundings, and the run that compares both engines on it. A plain "
      "number is in SI units; a text such as `12 deg` carries its unit.",
      {
          required("format", &Spec::format, text(), "The language's version: `spacecraft/1`."),
          required("name", &Spec::name, name(), "Names the emitted files."),
          optional("description", &Spec::description, text(), "Free text."),
          required("hub", &Spec::hub, object(hub_table()), "The body that carries the rest."),
          optional("wheels", &Spec::wheels, list_of(object(wheel_table())), "Reaction wheels."),
          optional("panels", &Spec::panels, list_of(object(panel_table())), "Solar arrays."),
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
                   "Analytic truths to compare each engine with: `kepler`, the two-body orbit; "
                   "`spin_up`, a rigid body under a constant torque about a principal axis."),
      }};
  return table;
}

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
  const Names names = named_components(spec, diagnostics);
  check(spec.hub, diagnostics);
  for (const WheelSpec& wheel : spec.wheels) check(wheel, names, diagnostics);
  for (const PanelSpec& panel : spec.panels) check(panel, names, diagnostics);
  for (const LoadSpec& load : spec.loads) check(load, names, diagnostics);
  check(spec.initial, spec.environment, diagnostics);
  check(spec.simulation, spec.panels, diagnostics);
  check(spec.engines, spec.environment, diagnostics);
  check_references(spec, diagnostics);
}

}  // namespace twincraft
