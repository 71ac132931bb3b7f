// States that the spec brings along, against the samples at their times.
// Tested by tests/runtime/stored_test.cpp.
#pragma once

#include "runtime/reference/reference.h"

namespace twincraft {

/// Is `time` [s] that of a stored state? Times are decimals, so equal up to a relative 1e-12.
bool is_stored_time(const StoredTruth& truth, double time);

/// `position_m`, `velocity_m_s`, `attitude_deg`, `rate_rad_s`: those that any state met by a sample
/// gives, with the tolerances of the spec.
std::vector<Deviation> stored_deviations(const StoredTruth& truth,
                                         std::span<const Observation> samples);

}  // namespace twincraft
