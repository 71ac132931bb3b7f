// The metrics: which quantity, over which coordinates, in which unit, judged by which tolerance.
// Norms follow the paper: Euclidean over a vector, over all panel and body angles and over all
// wheels; slosh coordinates by their largest single difference.
// Tested by tests/runtime/agreement_test.cpp.
#include "runtime/study/agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace twincraft {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;  // [deg/rad]

using Difference = std::function<double(const Observation&, const Observation&)>;

struct MetricLaw {
  std::string key;
  double unit;                      // key's units per SI unit
  std::optional<double> tolerance;  // SI
  Difference difference;            // SI
};

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

double wheel_difference(const Observation& a, const Observation& b) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.wheel_rate.size(); ++i)
    differences.push_back(a.wheel_rate[i] - b.wheel_rate[i]);
  return norm_of(Norm::kEuclidean, differences);
}

Difference distance(Vector3d Observation::*point) {
  return
      [point](const Observation& a, const Observation& b) { return (a.*point - b.*point).norm(); };
}

void add_attitude_laws(const Agreement& tolerance, std::vector<MetricLaw>& laws) {
  laws.push_back(
      {"attitude_deg", kDegrees, tolerance.attitude,
       [](const Observation& a, const Observation& b) { return principal_angle(a.q_BN, b.q_BN); }});
  laws.push_back({"rate_rad_s", 1.0, tolerance.rate, distance(&Observation::omega_BN_B)});
}

void add_translation_laws(const Agreement& tolerance, std::vector<MetricLaw>& laws) {
  // The position tolerance speaks of the system's centre of mass; B's own position has none.
  laws.push_back({"position_m", 1.0, std::nullopt, distance(&Observation::r_BN_N)});
  laws.push_back({"velocity_m_s", 1.0, tolerance.velocity, distance(&Observation::v_BN_N)});
  laws.push_back({"com_position_m", 1.0, tolerance.position, distance(&Observation::r_CN_N)});
}

void add_coordinate_laws(const Model& model, std::vector<MetricLaw>& laws) {
  using Kind = Coordinate::Kind;
  const Agreement& tolerance = model.agreement;
  const auto add = [&](const char* key, double unit, std::optional<double> limit,
                       const std::vector<Kind>& kinds, Norm norm) {
    std::vector<std::size_t> joints = joints_of(model, kinds);
    if (!joints.empty())
      laws.push_back({key, unit, limit, joint_difference(std::move(joints), norm)});
  };
  add("joint_deg", kDegrees, tolerance.joint, {Kind::kPanel, Kind::kBodyAngle}, Norm::kEuclidean);
  add("joint_m", 1.0, tolerance.travel, {Kind::kBodyDisplacement}, Norm::kEuclidean);
  if (!model.assembly.rotors.empty())
    laws.push_back({"wheel_rate_rad_s", 1.0, tolerance.wheel, wheel_difference});
  add("slosh_m", 1.0, tolerance.slosh, {Kind::kParticle}, Norm::kLargest);
  add("pendulum_deg", kDegrees, tolerance.joint, {Kind::kPendulum}, Norm::kLargest);
}

std::vector<MetricLaw> laws_of(const Model& model) {
  std::vector<MetricLaw> laws;
  if (!model.simulation.translation) add_attitude_laws(model.agreement, laws);
  add_translation_laws(model.agreement, laws);
  add_coordinate_laws(model, laws);
  laws.push_back(
      {"mass_kg", 1.0, model.agreement.mass,
       [](const Observation& a, const Observation& b) { return std::abs(a.mass - b.mass); }});
  return laws;
}

/// How many samples from the start both were taken at the same instants.
std::size_t common_samples(const Trajectory& a, const Trajectory& b) {
  const auto [end, unused] =
      std::mismatch(a.samples.begin(), a.samples.end(), b.samples.begin(), b.samples.end(),
                    [](const Observation& x, const Observation& y) { return x.time == y.time; });
  return static_cast<std::size_t>(end - a.samples.begin());
}

Metric measure(const MetricLaw& law, const Trajectory& a, const Trajectory& b, std::size_t count) {
  Peak peak;
  for (std::size_t i = 0; i < count; ++i)
    peak.see(law.difference(a.samples[i], b.samples[i]), a.samples[i].time);
  Metric metric{law.key, law.unit * peak.maximum, peak.at, std::nullopt};
  if (law.tolerance) metric.tolerance = law.unit * *law.tolerance;
  return metric;
}

Comparison measure_all(const std::vector<MetricLaw>& laws, const Trajectory& a,
                       const Trajectory& b) {
  Comparison comparison;
  const std::size_t count = common_samples(a, b);
  comparison.same_times = count > 0 && count == a.samples.size() && count == b.samples.size();
  if (count == 0) return comparison;
  for (const MetricLaw& law : laws) comparison.metrics.push_back(measure(law, a, b, count));
  return comparison;
}

}  // namespace

void Peak::see(double value, double time) {
  // Once NaN, `maximum` compares false with everything and stays; a NaN value is taken at once.
  if (std::isnan(maximum) || value <= maximum) return;
  maximum = value;
  at = time;
}

std::optional<bool> Metric::pass() const {
  if (!tolerance) return std::nullopt;
  return maximum <= *tolerance;
}

double principal_angle(const Quaterniond& a, const Quaterniond& b) {
  const Vector3d vec = a.w() * b.vec() - b.w() * a.vec() - a.vec().cross(b.vec());
  const double scalar = a.w() * b.w() + a.vec().dot(b.vec());
  return 2.0 * std::atan2(vec.norm(), std::abs(scalar));
}

MetricCurves metric_curves(const Model& model, const Trajectory& a, const Trajectory& b) {
  MetricCurves all{common_samples(a, b), {}};
  for (const MetricLaw& law : laws_of(model))
    all.curves.push_back({law.key, [law, &a, &b](std::size_t sample) {
                            return law.unit * law.difference(a.samples[sample], b.samples[sample]);
                          }});
  return all;
}

Comparison compare(const Model& model, const Trajectory& a, const Trajectory& b) {
  return measure_all(laws_of(model), a, b);
}

Comparison compare_hubs(bool translation, const Trajectory& a, const Trajectory& b) {
  std::vector<MetricLaw> laws;
  if (!translation) add_attitude_laws({}, laws);
  add_translation_laws({}, laws);
  return measure_all(laws, a, b);
}

}  // namespace twincraft
