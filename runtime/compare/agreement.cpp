#include "runtime/compare/agreement.h"

#include <algorithm>

#include "runtime/compare/pairing.h"
#include "runtime/engine/measure.h"

namespace twincraft {
void Peak::see(double value, double time) { keep_larger(value, time, maximum, at); }

std::optional<bool> Metric::pass() const {
  if (!tolerance) return std::nullopt;
  return maximum <= *tolerance;
}

AgreementMeter::AgreementMeter(std::vector<MetricLaw> laws)
    : laws_(std::move(laws)), now_(laws_.size()), peaks_(laws_.size()), sizes_(laws_.size()) {}

void AgreementMeter::take(const Observation& a, const Observation& b) {
  ++pairs_;
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    now_[i] = laws_[i].difference(a, b);
    peaks_[i].see(now_[i], a.time);
    sizes_[i] = std::max({sizes_[i], laws_[i].size(a), laws_[i].size(b)});
  }
}

Comparison AgreementMeter::result(bool same_times) const {
  Comparison comparison;
  comparison.same_times = same_times;
  if (pairs_ == 0) return comparison;
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    const double scale = laws_[i].row->scale;
    Metric metric{std::string(laws_[i].row->key), peaks_[i].maximum, peaks_[i].at, std::nullopt,
                  scale * sizes_[i]};
    if (laws_[i].tolerance) metric.tolerance = scale * *laws_[i].tolerance;
    comparison.metrics.push_back(std::move(metric));
  }
  return comparison;
}

namespace {

Comparison compare(std::vector<MetricLaw> laws, const Trajectory& a, const Trajectory& b) {
  AgreementMeter meter(std::move(laws));
  Pairing pairing([&meter](const Observation& x, const Observation& y) { meter.take(x, y); });
  for (std::size_t i = 0; i < std::max(a.samples.size(), b.samples.size()); ++i) {
    if (i < a.samples.size()) pairing.add(0, a.samples[i]);
    if (i < b.samples.size()) pairing.add(1, b.samples[i]);
  }
  return meter.result(pairing.same_times());
}

}  // namespace

Comparison compare(const Model& model, const Trajectory& a, const Trajectory& b) {
  return compare(metric_laws(model), a, b);
}

Comparison compare_hubs(bool translation, const Trajectory& a, const Trajectory& b) {
  return compare(hub_laws(translation), a, b);
}

}  // namespace twincraft
