// See reference.h. Tested by tests/runtime/reference_test.cpp.
#include "runtime/reference/reference.h"

#include <algorithm>
#include <cmath>

#include "runtime/reference/kepler.h"
#include "runtime/reference/spin_up.h"

namespace twincraft {
namespace {

/// Where in the hub every element with mass is, in both halves; false when one can move. A wheel on
/// the hub can not: its centre of mass is on its axis.
bool collect_fixed(const Model& model, std::vector<Vector3d>& positions) {
  const auto has_mass = [](const MassElement& element) { return element.mass > 0.0; };
  for (std::size_t link = 0; link < model.assembly.links.size(); ++link) {
    for (const MassElement& element : model.assembly.links[link].elements) {
      if (!has_mass(element)) continue;
      if (link > 0) return false;
      positions.push_back(element.r_EL_L);
    }
  }
  for (const TreeBody& body : model.tree.bodies) {
    const bool is_hub = body.parent < 0;
    const bool is_wheel_on_hub = body.parent == 0 && body.link < 0;
    for (const MassElement& element : body.elements) {
      if (!has_mass(element)) continue;
      if (!is_hub && !is_wheel_on_hub) return false;
      const Vector3d turned = body.quat * element.r_EL_L;
      positions.push_back(is_hub ? element.r_EL_L : body.pos + turned);
    }
  }
  return true;
}

}  // namespace

bool all_mass_at_one_point(const Model& model) {
  std::vector<Vector3d> positions;
  if (!collect_fixed(model, positions)) return false;
  return std::all_of(positions.begin(), positions.end(),
                     [&](const Vector3d& r) { return r == positions.front(); });
}

void widen(Deviation& deviation, double found, double time) {
  if (found <= deviation.max || std::isnan(deviation.max)) return;
  deviation.max = found;
  deviation.at = time;
}

std::string_view reference_name(ReferenceKind kind) {
  return kind == ReferenceKind::kKepler ? "kepler" : "spin_up";
}

std::optional<std::string> inapplicable(ReferenceKind kind, const Model& model, GravityLaw law) {
  return kind == ReferenceKind::kKepler ? kepler_inapplicable(model, law)
                                        : spin_up_inapplicable(model, law);
}

std::vector<Deviation> deviations(ReferenceKind kind, const Model& model,
                                  std::span<const Observation> samples) {
  return kind == ReferenceKind::kKepler ? kepler_deviations(model, samples)
                                        : spin_up_deviations(model, samples);
}

}  // namespace twincraft
