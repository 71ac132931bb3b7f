// See reference.h. Tested by tests/runtime/reference_test.cpp.
#include "runtime/reference/reference.h"

#include <cmath>
#include <numbers>

#include "runtime/reference/kepler.h"
#include "runtime/reference/spin_up.h"
#include "runtime/reference/stored.h"
#include "runtime/reference/torque_free.h"
#include "runtime/reference/tsiolkovsky.h"

namespace twincraft {

std::optional<bool> Deviation::pass() const {
  if (!tolerance) return std::nullopt;
  return max <= *tolerance;  // false for NaN
}

void widen(Deviation& deviation, double found, double time) {
  if (found <= deviation.max || std::isnan(deviation.max)) return;
  deviation.max = found;
  deviation.at = time;
}

double angle_deg(const Quaterniond& a, const Quaterniond& b) {
  const Quaterniond off = a.conjugate() * b;
  const double angle = 2.0 * std::atan2(off.vec().norm(), std::abs(off.w()));
  return angle * 180.0 / std::numbers::pi;
}

std::vector<Deviation> deviations(ReferenceKind kind, const Model& model,
                                  std::span<const Observation> samples) {
  switch (kind) {
    case ReferenceKind::kKepler:
      return kepler_deviations(model, samples);
    case ReferenceKind::kSpinUp:
      return spin_up_deviations(model, samples);
    case ReferenceKind::kTorqueFree:
      return torque_free_deviations(model, samples);
    case ReferenceKind::kTsiolkovsky:
      return tsiolkovsky_deviations(model, samples);
    case ReferenceKind::kStored:
      break;
  }
  return stored_deviations(model.stored, samples);
}

}  // namespace twincraft
