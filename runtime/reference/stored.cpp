// See stored.h. Tested by tests/runtime/stored_test.cpp.
#include "runtime/reference/stored.h"

#include <algorithm>
#include <cmath>

#include "runtime/engine/measure.h"

namespace twincraft {
namespace {

/// Deviations of one quantity, if it is compared at all.
struct Column {
  Deviation deviation;
  bool any = false;

  void see(double found, double time) {
    if (!any) deviation.at = time;  // also when there is no deviation at all
    any = true;
    deviation.see(found, time);
  }
};

struct Columns {
  Column position, velocity, attitude, rate;

  void compare(const StoredState& truth, bool of_hub, const Observation& sample) {
    const double time = sample.time;
    const Vector3d& r = of_hub ? sample.r_BN_N : sample.r_CN_N;
    const Vector3d& v = of_hub ? sample.v_BN_N : sample.v_CN_N;
    if (truth.position) position.see((r - *truth.position).norm(), time);
    if (truth.velocity) velocity.see((v - *truth.velocity).norm(), time);
    if (truth.q_BN) attitude.see(kDegrees * principal_angle(*truth.q_BN, sample.q_BN), time);
    if (truth.omega_BN_B) rate.see((sample.omega_BN_B - *truth.omega_BN_B).norm(), time);
  }
};

Columns empty_columns(const StoredTruth& truth) {
  std::optional<double> attitude = truth.attitude;
  if (attitude) *attitude *= kDegrees;
  return {{{.metric = "position_m", .tolerance = truth.position}},
          {{.metric = "velocity_m_s", .tolerance = truth.velocity}},
          {{.metric = "attitude_deg", .tolerance = attitude}},
          {{.metric = "rate_rad_s", .tolerance = truth.rate}}};
}

}  // namespace

bool is_stored_time(const StoredTruth& truth, double time) {
  return std::ranges::any_of(
      truth.states, [time](const StoredState& state) { return same_time(time, state.time); });
}

std::vector<Deviation> stored_deviations(const StoredTruth& truth,
                                         std::span<const Observation> samples) {
  Columns columns = empty_columns(truth);
  for (const StoredState& state : truth.states) {
    const auto met = std::ranges::find_if(samples, [&state](const Observation& sample) {
      return same_time(sample.time, state.time);
    });
    if (met != samples.end()) columns.compare(state, truth.of_hub, *met);
  }
  std::vector<Deviation> found;
  for (Column* column : {&columns.position, &columns.velocity, &columns.attitude, &columns.rate})
    if (column->any) found.push_back(column->deviation);
  return found;
}

}  // namespace twincraft
