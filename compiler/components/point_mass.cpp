// What a point mass cannot have. Whatever needs an attitude is refused, because none of it would
// have an effect. Tested by tests/compiler/point_mass_test.cpp.
#include <fmt/format.h>

#include <algorithm>

#include "compiler/components/spec.h"

namespace twincraft {
namespace {

constexpr const char* kHint = "`simulation.mode: full` moves a body with an attitude";

bool is_zero(const std::array<Schedule, 3>& vector) {
  return std::ranges::all_of(vector, &Schedule::is_zero);
}

void refuse(Span span, const std::string& message, Diagnostics& diagnostics) {
  diagnostics.error(Code::kPointMass, span, message).with_hint(kHint);
}

void refuse_all(const Spec& spec, const char* section, Diagnostics& diagnostics) {
  const Node* list = spec.node->find(section);
  if (list == nullptr || list->items.empty()) return;
  refuse(list->items.front().span, fmt::format("a point mass carries no {}", section), diagnostics);
}

void check_start(const InitialSpec& initial, Diagnostics& diagnostics) {
  if (initial.attitude) {
    refuse(initial.span_of("attitude"), "a point mass has no attitude", diagnostics);
  }
  if (!initial.rate.isZero(0.0)) {
    refuse(initial.span_of("rate"), "a point mass does not turn", diagnostics);
  }
}

void check_reference_to_turning(const Spec& spec, Diagnostics& diagnostics) {
  const auto found = std::ranges::find(spec.references, ReferenceKind::kSpinUp);
  if (found == spec.references.end()) return;
  const auto index = static_cast<std::size_t>(found - spec.references.begin());
  refuse(spec.node->find("references")->items[index].span,
         "`spin_up` describes a turning body, and a point mass does not turn", diagnostics);
}

}  // namespace

void check_point_mass(const Spec& spec, Diagnostics& diagnostics) {
  if (spec.simulation.mode != SimulationMode::kTranslation) return;
  for (const char* section : {"wheels", "panels", "bodies", "tanks", "slosh", "thrusters"}) {
    refuse_all(spec, section, diagnostics);
  }
  for (const LoadSpec& load : spec.loads) {
    if (is_zero(load.torque)) continue;
    refuse(load.span_of("torque"),
           fmt::format("the torque of load `{}` turns a point mass", load.name), diagnostics);
  }
  check_start(spec.initial, diagnostics);
  check_reference_to_turning(spec, diagnostics);
}

}  // namespace twincraft
