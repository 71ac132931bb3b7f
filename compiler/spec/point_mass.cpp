// What a point mass cannot have. Whatever needs an attitude is refused, because none of it would
// have an effect. Tested by tests/compiler/point_mass_test.cpp.
#include <fmt/format.h>

#include <algorithm>

#include "compiler/spec/spec.h"

namespace twincraft {
namespace {

constexpr const char* kHint = "`simulation.mode: full` moves a body with an attitude";

bool is_zero(const std::array<Schedule, 3>& vector) {
  return std::ranges::all_of(vector, &Schedule::is_zero);
}

void refuse(Span span, const std::string& message, Diagnostics& diagnostics) {
  diagnostics.error(Code::kPointMass, span, message).with_hint(kHint);
}

void refuse_components(const Spec& spec, Diagnostics& diagnostics) {
  for_each_section(spec, [&](const auto& members, const SectionName& section) {
    if (members.empty() || fits_point_mass(members.front())) return;
    refuse(written(members.front()).span(), fmt::format("a point mass carries no {}", section.key),
           diagnostics);
  });
}

void check_start(const InitialSpec& initial, Diagnostics& diagnostics) {
  if (initial.attitude) {
    refuse(initial.span_of("attitude"), "a point mass has no attitude", diagnostics);
  }
  if (!initial.rate.isZero(0.0)) {
    refuse(initial.span_of("rate"), "a point mass does not turn", diagnostics);
  }
}

/// A truth may be richer than the point mass that is held against it, but not about its attitude.
void check_stored_states(const Spec& spec, Diagnostics& diagnostics) {
  if (!spec.stored) return;
  for (const StoredStateSpec& state : spec.stored->states) {
    for (const char* key : {"attitude", "rate"}) {
      if (!state.has(key)) continue;
      refuse(state.span_of(key), fmt::format("a point mass has no {} to compare", key),
             diagnostics);
    }
  }
}

}  // namespace

void check_point_mass(const Spec& spec, Diagnostics& diagnostics) {
  if (spec.simulation.mode != SimulationMode::kTranslation) return;
  refuse_components(spec, diagnostics);
  for (const LoadSpec& load : spec.loads) {
    if (is_zero(load.torque)) continue;
    refuse(load.span_of("torque"),
           fmt::format("the torque of load `{}` turns a point mass", load.name), diagnostics);
  }
  check_start(spec.initial, diagnostics);
  check_stored_states(spec, diagnostics);
}

}  // namespace twincraft
