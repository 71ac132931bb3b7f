// From spec to model: every component adds itself to both halves, in the order of the language.
// Tested by tests/compiler/spec_test.cpp.
#include <fmt/format.h>

#include "compiler/components/physical.h"
#include "compiler/components/spec.h"
#include "compiler/ir/number.h"

namespace twincraft {
namespace {

Model lower_vehicle(const Spec& spec) {
  ModelBuilder builder(lower(spec.engines));
  lower(spec.hub, builder);
  for (const WheelSpec& wheel : spec.wheels) lower(wheel, builder);
  for (const PanelSpec& panel : spec.panels) lower(panel, builder);
  for (const LoadSpec& load : spec.loads) lower(load, builder);
  return std::move(builder).build();
}

bool is_physical(const MassProperties& inertial) {
  if (!(inertial.mass > kMujocoMinimum)) return false;
  const Physicality fate = physicality(inertial.I_PntC_L);
  return fate == Physicality::kPhysical || fate == Physicality::kOnEdge;
}

/// Token masses are taken out of what carries the wheels; something physical must be left.
void check_what_tokens_leave(const Spec& spec, const Model& model, Diagnostics& diagnostics) {
  for (const TreeBody& body : model.tree.bodies) {
    if (body.link < 0 || is_physical(body.inertial)) continue;
    const Span span = spec.engines.mujoco.node != nullptr
                          ? spec.engines.mujoco.span_of("wheel_mass")
                          : spec.span();
    diagnostics
        .error(
            Code::kTokenMassTooLarge, span,
            fmt::format("taking a token mass of {} kg for each massless wheel out of `{}` leaves "
                        "no physical body",
                        shortest(model.engines.wheel_mass), body.name))
        .with_hint("lower `engines.mujoco.wheel_mass`, or give the wheels their real mass");
  }
}

}  // namespace

std::optional<Model> lower(const Spec& spec, Diagnostics& diagnostics) {
  Model model = lower_vehicle(spec);
  const std::size_t errors_before = diagnostics.error_count();
  check_what_tokens_leave(spec, model, diagnostics);
  if (diagnostics.error_count() != errors_before) return std::nullopt;

  model.name = spec.name;
  model.description = spec.description;
  model.gravity = lower_gravity(spec.environment, spec.engines);
  lower(spec.initial, spec.environment, model);
  model.simulation = lower(spec.simulation, spec.panels);
  model.agreement = lower(spec.agreement);
  model.references = spec.references;
  return model;
}

}  // namespace twincraft
