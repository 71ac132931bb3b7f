// Time histories for the page: figures of like quantities, each with both engines' values beside
// the difference that the agreement table takes its maximum of.
// Tested by tests/runtime/html_test.cpp.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "runtime/report/report.h"

namespace twincraft {

/// `{samples, thinned, times: {bsm, mujoco, difference}, figures: [...]}`; columns of numbers are
/// base64 of little-endian doubles. An engine without samples has no times and no values.
nlohmann::ordered_json histories_json(const ReportedMember& member);

}  // namespace twincraft
