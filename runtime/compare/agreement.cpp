// The metrics: which quantity, over which coordinates, in which unit, judged by which tolerance.
// Norms follow the paper: Euclidean over a vector, over all panel and body angles and over all
// wheels; slosh coordinates by their largest single difference.
// Tested by tests/runtime/agreement_test.cpp.
#include "runtime/compare/agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "runtime/compare/pairing.h"
#include "runtime/engine/measure.h"

namespace twincraft {
namespace {

using Difference = decltype(MetricLaw::difference);
using Size = decltype(MetricLaw::size);

enum class Norm { kEuclidean, kLargest };

bool is_any_of(Coordinate::Kind kind, const std::vector<Coordinate::Kind>& kinds) {
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

/// Entries of the joint vector that belong to coordinates of these kinds.
std::vector<std::size_t> joints_of(const Model& model, const std::vector<Coordinate::Kind>& kinds) {
  std::vector<std::size_t> joints;
  for (const Coordinate& coordinate : model.coordinates)
    if (is_any_of(coordinate.kind, kinds))
      joints.push_back(static_cast<std::size_t>(coordinate.index - 1));
  return joints;
}

/// Written so that a NaN anywhere comes out as NaN, which std::max would lose.
double norm_of(Norm norm, const std::vector<double>& differences) {
  double sum = 0.0;
  Peak largest;
  for (double difference : differences) {
    sum += difference * difference;
    largest.see(std::abs(difference), 0.0);
  }
  return norm == Norm::kEuclidean ? std::sqrt(sum) : largest.maximum;
}

Difference joint_difference(std::vector<std::size_t> joints, Norm norm) {
  return [joints = std::move(joints), norm](const Observation& a, const Observation& b) {
    std::vector<double> differences;
    for (std::size_t joint : joints)
      differences.push_back(a.joint_position[joint] - b.joint_position[joint]);
    return norm_of(norm, differences);
  };
}

Size joint_size(std::vector<std::size_t> joints, Norm norm) {
  return [joints = std::move(joints), norm](const Observation& a) {
    std::vector<double> sizes;
    for (std::size_t joint : joints) sizes.push_back(a.joint_position[joint]);
    return norm_of(norm, sizes);
  };
}

double wheel_difference(const Observation& a, const Observation& b) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.wheel_rate.size(); ++i)
    differences.push_back(a.wheel_rate[i] - b.wheel_rate[i]);
  return norm_of(Norm::kEuclidean, differences);
}

double wheel_size(const Observation& a) { return norm_of(Norm::kEuclidean, a.wheel_rate); }

/// Components of a quaternion are rounded as numbers near one are.
double attitude_size(const Observation& /*a*/) { return 1.0; }

Size length(Vector3d Observation::*point) {
  return [point](const Observation& a) { return (a.*point).norm(); };
}

/// A position near the origin is the sum of terms as long as the vehicle: of the order of 1 m.
Size position_size(Vector3d Observation::*point) {
  return [point](const Observation& a) { return std::max(1.0, (a.*point).norm()); };
}

Difference distance(Vector3d Observation::*point) {
  return
      [point](const Observation& a, const Observation& b) { return (a.*point - b.*point).norm(); };
}

void add_attitude_laws(const Agreement& tolerance, std::vector<MetricLaw>& laws) {
  laws.push_back(
      {"attitude_deg", kDegrees, tolerance.attitude,
       [](const Observation& a, const Observation& b) { return principal_angle(a.q_BN, b.q_BN); },
       attitude_size});
  laws.push_back({"rate_rad_s", 1.0, tolerance.rate, distance(&Observation::omega_BN_B),
                  length(&Observation::omega_BN_B)});
}

void add_translation_laws(const Agreement& tolerance, std::vector<MetricLaw>& laws) {
  // The position tolerance speaks of the system's centre of mass; B's own position has none.
  using Part = Vector3d Observation::*;
  const Part r_BN_N = &Observation::r_BN_N, v_BN_N = &Observation::v_BN_N,
             r_CN_N = &Observation::r_CN_N;
  laws.push_back({"position_m", 1.0, std::nullopt, distance(r_BN_N), position_size(r_BN_N)});
  laws.push_back({"velocity_m_s", 1.0, tolerance.velocity, distance(v_BN_N), length(v_BN_N)});
  laws.push_back(
      {"com_position_m", 1.0, tolerance.position, distance(r_CN_N), position_size(r_CN_N)});
}

void add_coordinate_laws(const Model& model, std::vector<MetricLaw>& laws) {
  using Kind = Coordinate::Kind;
  const Agreement& tolerance = model.agreement;
  const auto add = [&](const char* key, double unit, std::optional<double> limit,
                       const std::vector<Kind>& kinds, Norm norm) {
    const std::vector<std::size_t> joints = joints_of(model, kinds);
    if (!joints.empty())
      laws.push_back({key, unit, limit, joint_difference(joints, norm), joint_size(joints, norm)});
  };
  add("joint_deg", kDegrees, tolerance.joint, {Kind::kPanel, Kind::kBodyAngle}, Norm::kEuclidean);
  add("joint_m", 1.0, tolerance.travel, {Kind::kBodyDisplacement}, Norm::kEuclidean);
  if (!model.assembly.rotors.empty())
    laws.push_back({"wheel_rate_rad_s", 1.0, tolerance.wheel, wheel_difference, wheel_size});
  add("slosh_m", 1.0, tolerance.slosh, {Kind::kParticle}, Norm::kLargest);
  add("pendulum_deg", kDegrees, tolerance.joint, {Kind::kPendulum}, Norm::kLargest);
}

}  // namespace

void Peak::see(double value, double time) { keep_larger(value, time, maximum, at); }

std::optional<bool> Metric::pass() const {
  if (!tolerance) return std::nullopt;
  return maximum <= *tolerance;
}

std::vector<MetricLaw> metric_laws(const Model& model) {
  std::vector<MetricLaw> laws;
  if (!model.simulation.translation) add_attitude_laws(model.agreement, laws);
  add_translation_laws(model.agreement, laws);
  add_coordinate_laws(model, laws);
  laws.push_back(
      {"mass_kg", 1.0, model.agreement.mass,
       [](const Observation& a, const Observation& b) { return std::abs(a.mass - b.mass); },
       [](const Observation& a) { return a.mass; }});
  return laws;
}

std::vector<MetricLaw> hub_laws(bool translation) {
  std::vector<MetricLaw> laws;
  if (!translation) add_attitude_laws({}, laws);
  add_translation_laws({}, laws);
  return laws;
}

AgreementMeter::AgreementMeter(std::vector<MetricLaw> laws)
    : laws_(std::move(laws)), now_(laws_.size()), peaks_(laws_.size()), sizes_(laws_.size()) {}

void AgreementMeter::take(const Observation& a, const Observation& b) {
  ++pairs_;
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    now_[i] = laws_[i].unit * laws_[i].difference(a, b);
    peaks_[i].see(now_[i], a.time);
    sizes_[i] = std::max({sizes_[i], laws_[i].size(a), laws_[i].size(b)});
  }
}

Comparison AgreementMeter::result(bool same_times) const {
  Comparison comparison;
  comparison.same_times = same_times;
  if (pairs_ == 0) return comparison;
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    Metric metric{laws_[i].key, peaks_[i].maximum, peaks_[i].at, std::nullopt,
                  laws_[i].unit * sizes_[i]};
    if (laws_[i].tolerance) metric.tolerance = laws_[i].unit * *laws_[i].tolerance;
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
