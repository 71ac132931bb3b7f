// Norms follow the paper: Euclidean over a vector, over all panel and body angles and over all
// wheels; slosh coordinates by their largest single difference.
#include "runtime/compare/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/engine/measure.h"

namespace twincraft {
namespace {

using Of = MetricRow::Of;
using Output = OutputSignal::Of;
using Limits = AgreementTolerances;

double attitude_difference(const Observation& a, const Observation& b, Coordinates) {
  return principal_angle(a.q_BN, b.q_BN);
}
/// Components of a quaternion are rounded as numbers near one are.
double attitude_size(const Observation&, Coordinates) { return 1.0; }

template <auto part>
double distance(const Observation& a, const Observation& b, Coordinates) {
  return (a.*part - b.*part).norm();
}
template <auto part>
double length(const Observation& seen, Coordinates) {
  return (seen.*part).norm();
}
/// A position near the origin is the sum of terms as long as the vehicle: of the order of 1 m.
template <auto part>
double position_size(const Observation& seen, Coordinates) {
  return std::max(1.0, (seen.*part).norm());
}

double mass_difference(const Observation& a, const Observation& b, Coordinates) {
  return std::abs(a.mass - b.mass);
}
double mass_size(const Observation& seen, Coordinates) { return seen.mass; }

/// A wheel is compared by its rate: its angle nobody knows.
double compared(const Coordinate& coordinate, const Observation& seen) {
  return coordinate.is_wheel() ? rate_of(coordinate, seen) : position_of(coordinate, seen);
}

double euclidean(Coordinates coordinates, const auto& value_of) {
  double sum = 0.0;
  for (const Coordinate& coordinate : coordinates) {
    const double value = value_of(coordinate);
    sum += value * value;
  }
  return std::sqrt(sum);
}

double largest(Coordinates coordinates, const auto& value_of) {
  double maximum = 0.0, at = 0.0;  // std::max would lose a NaN
  for (const Coordinate& coordinate : coordinates)
    keep_larger(std::abs(value_of(coordinate)), 0.0, maximum, at);
  return maximum;
}

auto apart(const Observation& a, const Observation& b) {
  return [&a, &b](const Coordinate& coordinate) {
    return compared(coordinate, a) - compared(coordinate, b);
  };
}
auto in(const Observation& seen) {
  return [&seen](const Coordinate& coordinate) { return compared(coordinate, seen); };
}

double euclidean_difference(const Observation& a, const Observation& b, Coordinates coordinates) {
  return euclidean(coordinates, apart(a, b));
}
double euclidean_size(const Observation& seen, Coordinates coordinates) {
  return euclidean(coordinates, in(seen));
}
double largest_difference(const Observation& a, const Observation& b, Coordinates coordinates) {
  return largest(coordinates, apart(a, b));
}
double largest_size(const Observation& seen, Coordinates coordinates) {
  return largest(coordinates, in(seen));
}

// The tolerance of the position speaks of the system's centre of mass; B's own position has none.
constexpr std::array kMetrics{
    MetricRow{"attitude_deg", "attitude", "deg", kDegrees, &Limits::attitude, Of::kTurningHub,
              Output::kAttitude, attitude_difference, attitude_size},
    MetricRow{"rate_rad_s", "body rate", "rad/s", 1.0, &Limits::rate, Of::kTurningHub,
              Output::kHubRate, distance<&Observation::omega_BN_B>,
              length<&Observation::omega_BN_B>},
    MetricRow{"position_m", "hub position", "m", 1.0, nullptr, Of::kHub, Output::kHubPosition,
              distance<&Observation::r_BN_N>, position_size<&Observation::r_BN_N>},
    MetricRow{"velocity_m_s", "hub velocity", "m/s", 1.0, &Limits::velocity, Of::kHub,
              Output::kHubVelocity, distance<&Observation::v_BN_N>, length<&Observation::v_BN_N>},
    MetricRow{"com_position_m", "system CoM", "m", 1.0, &Limits::position, Of::kHub,
              Output::kComPosition, distance<&Observation::r_CN_N>,
              position_size<&Observation::r_CN_N>},
    MetricRow{"joint_deg", "joint angles", "deg", kDegrees, &Limits::joint, Of::kCoordinates,
              Output::kCoordinate, euclidean_difference, euclidean_size},
    MetricRow{"joint_m", "joint travel", "m", 1.0, &Limits::travel, Of::kCoordinates,
              Output::kCoordinate, euclidean_difference, euclidean_size},
    MetricRow{"wheel_rate_rad_s", "wheel rate", "rad/s", 1.0, &Limits::wheel, Of::kCoordinates,
              Output::kCoordinateRate, euclidean_difference, euclidean_size},
    MetricRow{"slosh_m", "slosh", "m", 1.0, &Limits::slosh, Of::kCoordinates, Output::kCoordinate,
              largest_difference, largest_size},
    MetricRow{"pendulum_deg", "pendulum", "deg", kDegrees, &Limits::joint, Of::kCoordinates,
              Output::kCoordinate, largest_difference, largest_size},
    MetricRow{"mass_kg", "mass", "kg", 1.0, &Limits::mass, Of::kVehicle, Output::kMass,
              mass_difference, mass_size},
};

std::vector<Coordinate> coordinates_of(const MetricRow& row, const Model& model) {
  std::vector<Coordinate> coordinates;
  for (const Coordinate& coordinate : model.coordinates)
    if (kind_of(coordinate).metric == row.key) coordinates.push_back(coordinate);
  return coordinates;
}

bool applies_to_hub(const MetricRow& row, bool translation) {
  return row.of == Of::kHub || (row.of == Of::kTurningHub && !translation);
}

bool applies(const MetricLaw& law, const Model& model) {
  if (law.row->of == Of::kCoordinates) return !law.coordinates.empty();
  return law.row->of == Of::kVehicle || applies_to_hub(*law.row, model.simulation.translation);
}

}  // namespace

const MetricRow* find_metric_row(std::string_view key) {
  const auto* row = std::ranges::find(kMetrics, key, &MetricRow::key);
  return row == kMetrics.end() ? nullptr : row;
}

std::vector<MetricLaw> metric_laws(const Model& model) {
  std::vector<MetricLaw> laws;
  for (const MetricRow& row : kMetrics) {
    MetricLaw law{&row, std::nullopt, coordinates_of(row, model)};
    if (row.tolerance != nullptr) law.tolerance = model.agreement.*row.tolerance;
    if (applies(law, model)) laws.push_back(std::move(law));
  }
  return laws;
}

bool MetricRow::takes(const OutputSignal& output) const {
  return output.of == reads && (!output.coordinate || kind_of(*output.coordinate).metric == key);
}

std::vector<MetricLaw> metric_laws(const Model& model, std::span<const OutputSignal> held) {
  std::vector<MetricLaw> laws = metric_laws(model);
  std::erase_if(laws, [held](MetricLaw& law) {
    law.coordinates.clear();
    bool is_held = false;
    for (const OutputSignal& output : held) {
      if (!law.row->takes(output)) continue;
      is_held = true;
      if (output.coordinate) law.coordinates.push_back(*output.coordinate);
    }
    return !is_held;
  });
  return laws;
}

std::vector<MetricLaw> hub_laws(bool translation) {
  std::vector<MetricLaw> laws;
  for (const MetricRow& row : kMetrics)
    if (applies_to_hub(row, translation)) laws.push_back({.row = &row});
  return laws;
}

}  // namespace twincraft
