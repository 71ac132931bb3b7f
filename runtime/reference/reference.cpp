// See reference.h. Tested by tests/runtime/reference_test.cpp.
#include "runtime/reference/reference.h"

#include "runtime/engine/measure.h"
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

void Deviation::see(double found, double time) { keep_larger(found, time, max, at); }

namespace {

std::vector<Deviation> measured(ReferenceKind kind, const Model& model,
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

/// Nothing for `stored`, which brings its tolerances along.
const ReferenceTolerance* tolerances_of(ReferenceKind kind, const ReferenceTolerances& all) {
  switch (kind) {
    case ReferenceKind::kKepler:
      return &all.kepler;
    case ReferenceKind::kSpinUp:
      return &all.spin_up;
    case ReferenceKind::kTorqueFree:
      return &all.torque_free;
    case ReferenceKind::kTsiolkovsky:
      return &all.tsiolkovsky;
    case ReferenceKind::kStored:
      break;
  }
  return nullptr;
}

/// In the unit of the metric.
std::optional<double> tolerance_of(std::string_view metric, const ReferenceTolerance& tolerance) {
  if (metric == "position_m") return tolerance.position;
  if (metric == "velocity_m_s") return tolerance.velocity;
  if (metric == "rate_rad_s") return tolerance.rate;
  if (metric == "delta_v_relative") return tolerance.delta_v;
  if (!tolerance.attitude) return std::nullopt;
  return *tolerance.attitude * kDegrees;
}

}  // namespace

std::vector<Deviation> deviations(ReferenceKind kind, const Model& model,
                                  std::span<const Observation> samples) {
  std::vector<Deviation> found = measured(kind, model, samples);
  const ReferenceTolerance* tolerances = tolerances_of(kind, model.agreement.references);
  if (tolerances == nullptr) return found;
  for (Deviation& deviation : found)
    deviation.tolerance = tolerance_of(deviation.metric, *tolerances);
  return found;
}

}  // namespace twincraft
