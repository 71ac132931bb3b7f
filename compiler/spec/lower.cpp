// From spec to model: the vehicle adds itself to both halves, then come the sections of the run.
// Tested by tests/compiler/spec_test.cpp.
#include <fmt/format.h>

#include <set>

#include "compiler/analysis/truth.h"
#include "compiler/components/physical.h"
#include "compiler/ir/number.h"
#include "compiler/spec/spec.h"

namespace twincraft {
namespace {

Model lower_vehicle(const Spec& spec) {
  ModelBuilder builder(lower(spec.engines));
  lower(spec, builder);
  return std::move(builder).build();
}

bool is_physical(const MassProperties& inertial) {
  if (!(inertial.mass > kMujocoMinimum)) return false;
  const Physicality fate = physicality(inertial.I_PntC_L);
  return fate == Physicality::kPhysical || fate == Physicality::kOnEdge;
}

/// Token masses are taken out of what carries the wheels; something physical must be left.
void check_what_tokens_leave(const Spec& spec, const Model& model, Diagnostics& diagnostics) {
  std::set<int> mounts;
  for (const TreeBody& body : model.tree.bodies) {
    if (body.link < 0) mounts.insert(body.parent);
  }
  for (const int mount : mounts) {
    const TreeBody& body = model.tree.bodies[static_cast<std::size_t>(mount)];
    if (is_physical(body.inertial)) continue;
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

/// Once for every branch that grows too deep, at the first body that is.
void warn_of_depth(const Spec& spec, const Model& model, Diagnostics& diagnostics) {
  const std::vector<int> depths = depths_of(model.tree);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (depths[i] != kMaximumTreeDepth + 1) continue;
    const std::string& name = model.tree.bodies[i].name;
    const std::string component = name.substr(0, name.find('.'));  // of `wing.96`
    diagnostics.warning(
        Code::kChainTooDeep, depth_span(spec, component).value_or(spec.span()),
        fmt::format("`{}` is body {} of a chain, and MuJoCo loads chains of {}: the analytic "
                    "engine goes on alone",
                    name, depths[i], kMaximumTreeDepth));
  }
}

/// At the component that is too many.
void warn_of_size(const Spec& spec, Diagnostics& diagnostics) {
  const Size size = size_of(spec, kMaximumTreeCoordinates);
  if (!size.too_many_at) return;
  diagnostics.warning(
      Code::kTooLargeForMujoco, *size.too_many_at,
      fmt::format("here the vehicle gets more than {} joints and wheels, as many as MuJoCo loads: "
                  "the analytic engine goes on alone",
                  kMaximumTreeCoordinates));
}

/// At the word of every reference that is not this vehicle's motion.
void check_references(const Spec& spec, const Model& model, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < spec.references.size(); ++i) {
    const ReferenceKind kind = spec.references[i];
    const std::optional<std::string> reason = inapplicable(kind, model);
    if (!reason) continue;
    diagnostics.error(Code::kReferenceInapplicable, spec.node->find("references")->items[i].span,
                      fmt::format("`{}` does not apply: {}", reference_name(kind), *reason));
  }
}

}  // namespace

std::optional<Model> lower(const Spec& spec, Diagnostics& diagnostics) {
  Model model = lower_vehicle(spec);
  const std::size_t errors_before = diagnostics.error_count();
  check_what_tokens_leave(spec, model, diagnostics);
  if (diagnostics.error_count() != errors_before) return std::nullopt;
  warn_of_depth(spec, model, diagnostics);
  warn_of_size(spec, diagnostics);

  model.name = spec.name;
  model.description = spec.description;
  model.gravity = lower_gravity(spec.environment, spec.engines);
  lower(spec.initial, spec.environment, model);
  model.simulation = lower(spec.simulation, oscillators(spec));
  model.agreement = lower(spec.agreement);
  model.references = spec.references;
  if (spec.stored && names_stored(spec)) model.stored = lower(*spec.stored, spec.environment);
  check_references(spec, model, diagnostics);
  return model;
}

}  // namespace twincraft
