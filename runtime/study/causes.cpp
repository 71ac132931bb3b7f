// See causes.h. Tested by tests/runtime/attribution_test.cpp and
// tests/agreement/attribution_test.cpp.
#include "runtime/study/causes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compiler/ir/gravity_law.h"
#include "compiler/ir/number.h"
#include "runtime/integrate/tableau.h"

namespace twincraft {
namespace {

std::string set(std::string_view path, double value) {
  return fmt::format("{}={}", path, shortest(value));
}

std::vector<Scaling> scaled(std::string_view path, double value,
                            std::initializer_list<double> factors) {
  std::vector<Scaling> scalings;
  for (double factor : factors) scalings.push_back({factor, {set(path, factor * value)}});
  return scalings;
}

bool has(const Model& model, Coordinate::Kind kind) {
  return std::any_of(model.coordinates.begin(), model.coordinates.end(),
                     [kind](const Coordinate& coordinate) { return coordinate.kind == kind; });
}

// ---- velocity artefact

bool is_inertial(const Bundle& bundle) {
  return bundle.model.engines.frame == MujocoFrame::kInertial;
}

bool in_deep_space(const Bundle& bundle) { return bundle.model.gravity.mu == 0.0; }

/// As the spec has it, SI; zero on an orbit of elements.
Vector3d initial_velocity(const Bundle& bundle) {
  const nlohmann::json resolved = nlohmann::json::parse(bundle.resolved_json, nullptr, false);
  const nlohmann::json::json_pointer place("/initial/velocity");
  if (resolved.is_discarded() || !resolved.contains(place)) return Vector3d::Zero();
  const std::vector<double> v = resolved[place].get<std::vector<double>>();
  return {v.at(0), v.at(1), v.at(2)};
}

/// Powers of two, so that the products whose rounding this is have the same digits.
std::vector<Scaling> scale_speed(const Bundle& bundle) {
  const Vector3d v = initial_velocity(bundle);
  std::vector<Scaling> scalings;
  if (!in_deep_space(bundle) || v.isZero(0.0)) return scalings;
  for (double factor : {0.5, 0.25})
    scalings.push_back({factor,
                        {fmt::format("initial.velocity=[{}, {}, {}]", shortest(factor * v.x()),
                                     shortest(factor * v.y()), shortest(factor * v.z()))}});
  return scalings;
}

std::string why_speed_stays(const Bundle& bundle) {
  return in_deep_space(bundle) ? "speed not scaled: it starts at rest"
                               : "speed not scaled: it is the orbit's";
}

// ---- tokens

bool adds_wheel_mass(const Bundle& bundle) {
  // A token that was taken out of its mount is no element.
  const std::vector<TreeBody>& bodies = bundle.model.tree.bodies;
  return !bundle.model.engines.compensate &&
         std::any_of(bodies.begin(), bodies.end(),
                     [](const TreeBody& body) { return body.link < 0 && !body.elements.empty(); });
}

std::vector<Scaling> scale_wheel_mass(const Bundle& bundle) {
  return scaled("engines.mujoco.wheel_mass", bundle.model.engines.wheel_mass, {0.1, 0.01});
}

bool adds_bob_inertia(const Bundle& bundle) {
  return bundle.model.engines.bob_inertia > 0.0 && has(bundle.model, Coordinate::Kind::kPendulum);
}

std::vector<Scaling> scale_bob_inertia(const Bundle& bundle) {
  return scaled("engines.mujoco.bob_inertia", bundle.model.engines.bob_inertia, {10.0, 0.1});
}

bool adds_particle_inertia(const Bundle& bundle) {
  return bundle.model.engines.particle_inertia > 0.0 &&
         has(bundle.model, Coordinate::Kind::kParticle);
}

std::vector<Scaling> scale_particle_inertia(const Bundle& bundle) {
  return scaled("engines.mujoco.particle_inertia", bundle.model.engines.particle_inertia,
                {10.0, 0.1});
}

// ---- gravity

bool has_two_laws(const Bundle& bundle) {
  return bundle.model.gravity.bsm != bundle.model.gravity.mujoco;
}

// ---- attitude chart

bool has_two_charts(const Bundle& bundle) {
  return !bundle.model.simulation.translation &&
         bundle.model.engines.attitude == AttitudeChart::kMrp;
}

// ---- the table

using Applies = bool (*)(const Bundle&);
using Remove = Overrides (*)(const Bundle&);
using Scale = std::vector<Scaling> (*)(const Bundle&);
using WhyNot = std::string (*)(const Bundle&);

struct Rule {
  const char* key;
  const char* name;
  Applies applies;
  Remove remove;
  const char* variable;
  Scale scale;
  WhyNot why_not;  // asked when `scale` has nothing
};

std::vector<Scaling> no_scaling(const Bundle&) { return {}; }
std::string no_reason(const Bundle&) { return {}; }

const std::array kRules{
    Rule{"velocity_artefact", "velocity artefact", is_inertial,
         [](const Bundle&) -> Overrides { return {"engines.mujoco.frame=comoving"}; }, "speed",
         scale_speed, why_speed_stays},
    Rule{"wheel_mass", "token wheel mass", adds_wheel_mass,
         [](const Bundle&) -> Overrides { return {"engines.mujoco.compensate=true"}; },
         "wheel mass", scale_wheel_mass, no_reason},
    Rule{"bob_inertia", "bob inertia", adds_bob_inertia,
         [](const Bundle&) -> Overrides { return {"engines.mujoco.bob_inertia=0"}; }, "bob inertia",
         scale_bob_inertia, no_reason},
    Rule{"particle_inertia", "particle inertia", adds_particle_inertia,
         [](const Bundle&) -> Overrides { return {"engines.mujoco.particle_inertia=0"}; },
         "particle inertia", scale_particle_inertia, no_reason},
    Rule{"gravity_application", "gravity application", has_two_laws,
         [](const Bundle& bundle) -> Overrides {
           return {fmt::format("engines.bsm.gravity={}", word_of(bundle.model.gravity.mujoco))};
         },
         "", no_scaling,
         [](const Bundle&) -> std::string { return "two laws, with no size between them"; }},
    Rule{"attitude_chart", "attitude chart", has_two_charts,
         [](const Bundle&) -> Overrides { return {"engines.bsm.attitude=quaternion"}; }, "step",
         [](const Bundle& bundle) { return step_scaling(bundle.model, 0.5); },
         [](const Bundle&) -> std::string { return "step not scaled: an adaptive method"; }},
};

}  // namespace

std::vector<Scaling> step_scaling(const Model& model, double factor) {
  const SimulationPlan& plan = model.simulation;
  if (tableau_of(plan.method).adaptive) return {};
  // A record that is no multiple of the step lands elsewhere with another step.
  const double steps = plan.record / plan.step;
  const bool is_multiple = std::abs(steps - std::round(steps)) < 1.0e-9 * steps;
  const double record = is_multiple && plan.record > plan.step ? plan.record : plan.step;
  return {{factor, {set("simulation.step", factor * plan.step), set("simulation.record", record)}}};
}

std::vector<Cause> causes_of(const Bundle& bundle) {
  std::vector<Cause> causes;
  for (const Rule& rule : kRules) {
    if (!rule.applies(bundle)) continue;
    Cause cause{rule.key, rule.name, rule.remove(bundle), rule.variable, rule.scale(bundle), {}};
    if (cause.scalings.empty()) cause.not_scaled = rule.why_not(bundle);
    causes.push_back(std::move(cause));
  }
  return causes;
}

}  // namespace twincraft
