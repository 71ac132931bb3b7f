// See error_series.h. Tested by tests/runtime/attribution_test.cpp.
#include "runtime/compare/error_series.h"

#include <cmath>
#include <functional>

#include "runtime/compare/agreement.h"
#include "runtime/engine/measure.h"

namespace twincraft {
namespace {

/// Calls `each(i, j)` for the samples i and j that were taken at one instant.
template <class TimeA, class TimeB, class Each>
void at_common_times(std::size_t size_a, const TimeA& time_a, std::size_t size_b,
                     const TimeB& time_b, const Each& each) {
  for (std::size_t i = 0, j = 0; i < size_a && j < size_b;) {
    if (same_time(time_a(i), time_b(j)))
      each(i++, j++);
    else if (time_a(i) < time_b(j))
      ++i;
    else
      ++j;
  }
}

/// Keeps its relative accuracy down to the smallest angles, as principal_angle() does.
Vector3d rotation_vector(const Quaterniond& a, const Quaterniond& b) {
  const Vector3d vec = a.w() * b.vec() - b.w() * a.vec() + a.vec().cross(b.vec());
  const double scalar = a.w() * b.w() + a.vec().dot(b.vec());
  const double sine = vec.norm();
  if (sine == 0.0) return Vector3d::Zero();
  const double angle = 2.0 * std::atan2(sine, std::abs(scalar));
  return std::copysign(angle / sine, scalar) * vec;
}

using Law = std::function<Vector3d(const Observation&, const Observation&)>;

ErrorSeries series_of(const Law& law, const Trajectory& a, const Trajectory& b) {
  ErrorSeries series;
  at_common_times(
      a.samples.size(), [&a](std::size_t i) { return a.samples[i].time; }, b.samples.size(),
      [&b](std::size_t j) { return b.samples[j].time; },
      [&](std::size_t i, std::size_t j) {
        series.time.push_back(a.samples[i].time);
        series.value.push_back(law(a.samples[i], b.samples[j]));
      });
  return series;
}

template <class Each>
void at_common_times(const ErrorSeries& x, const ErrorSeries& y, const Each& each) {
  at_common_times(
      x.time.size(), [&x](std::size_t i) { return x.time[i]; }, y.time.size(),
      [&y](std::size_t j) { return y.time[j]; }, each);
}

}  // namespace

double ErrorSeries::maximum() const {
  Peak peak;
  for (std::size_t i = 0; i < time.size(); ++i) peak.see(value[i].norm(), time[i]);
  return peak.maximum;
}

ErrorSeries attitude_error(const Trajectory& a, const Trajectory& b) {
  return series_of(
      [](const Observation& x, const Observation& y) { return rotation_vector(x.q_BN, y.q_BN); }, a,
      b);
}

ErrorSeries position_error(const Trajectory& a, const Trajectory& b) {
  return series_of(
      [](const Observation& x, const Observation& y) -> Vector3d { return y.r_CN_N - x.r_CN_N; }, a,
      b);
}

ErrorSeries joint_error(std::size_t joint, const Trajectory& a, const Trajectory& b) {
  return series_of(
      [joint](const Observation& x, const Observation& y) -> Vector3d {
        return {y.joint_position[joint] - x.joint_position[joint], 0.0, 0.0};
      },
      a, b);
}

ErrorSeries difference(const ErrorSeries& x, const ErrorSeries& y) {
  ErrorSeries series;
  at_common_times(x, y, [&](std::size_t i, std::size_t j) {
    series.time.push_back(x.time[i]);
    series.value.emplace_back(x.value[i] - y.value[j]);
  });
  return series;
}

double share(const ErrorSeries& whole, const ErrorSeries& without) {
  double gone = 0.0, all = 0.0;
  at_common_times(whole, without, [&](std::size_t i, std::size_t j) {
    gone += (whole.value[i] - without.value[j]).dot(whole.value[i]);
    all += whole.value[i].squaredNorm();
  });
  return all == 0.0 ? 0.0 : gone / all;
}

double log_slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto count = static_cast<double>(x.size());
  double mean_x = 0.0, mean_y = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += std::log(x[i]) / count;
    mean_y += std::log(y[i]) / count;
  }
  double covariance = 0.0, variance = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    covariance += (std::log(x[i]) - mean_x) * (std::log(y[i]) - mean_y);
    variance += (std::log(x[i]) - mean_x) * (std::log(x[i]) - mean_x);
  }
  return covariance / variance;
}

}  // namespace twincraft
