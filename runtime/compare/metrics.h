// What the engines are compared in, a row for each metric: its key in report.json, its words, the
// tolerance that judges it, and how it is taken from two samples. Adding a metric is adding a row.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "runtime/engine/observation.h"

namespace twincraft {

/// The coordinates that a metric compares, see CoordinateKind::metric; none of the hub's metrics.
using Coordinates = std::span<const Coordinate>;

struct MetricRow {
  enum class Of {
    kTurningHub,   // every vehicle but a point mass
    kHub,          // every vehicle
    kCoordinates,  // those that have such coordinates
    kVehicle,      // every vehicle, and no part of comparing hubs
  };

  std::string_view key;                                   // ends in its unit: `attitude_deg`
  std::string_view label, unit;                           // for people: `attitude`, `deg`
  double scale;                                           // key's units per SI unit
  std::optional<double> AgreementTolerances::*tolerance;  // of the spec; null: never judged
  Of of;
  OutputSignal::Of reads;  // what it is taken from
  /// How different two samples are [SI]; a NaN anywhere comes out as NaN.
  double (*difference)(const Observation& a, const Observation& b, Coordinates coordinates);
  /// How large the quantity itself is [SI].
  double (*size)(const Observation& seen, Coordinates coordinates);

  /// The metric is taken from this output, among others.
  bool takes(const OutputSignal& output) const;
};

/// Nothing when no metric has this key.
const MetricRow* find_metric_row(std::string_view key);

/// A metric as it applies to one vehicle.
struct MetricLaw {
  const MetricRow* row;
  std::optional<double> tolerance = {};      // [SI]
  std::vector<Coordinate> coordinates = {};  // that it compares

  double difference(const Observation& a, const Observation& b) const {  // in the key's unit
    return row->scale * row->difference(a, b, coordinates);
  }
  double size(const Observation& seen) const { return row->size(seen, coordinates); }  // [SI]
};

/// Those that apply to a vehicle, in the order of the report.
std::vector<MetricLaw> metric_laws(const Model& model);
/// The same of samples that hold these outputs and no others.
std::vector<MetricLaw> metric_laws(const Model& model, std::span<const OutputSignal> held);
/// Those of the hub alone, which judge nothing: see compare_hubs().
std::vector<MetricLaw> hub_laws(bool translation);

}  // namespace twincraft
