// What the replay moves: the state of the vehicle at evenly spread samples, and when its thrusters
// burn. What it draws is the emitted MJCF itself. Tested by tests/runtime/html_test.cpp.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "runtime/study/results.h"

namespace twincraft {

/// Null for a vehicle that MuJoCo refuses. Columns of numbers are base64 of little-endian doubles.
nlohmann::ordered_json replay_json(const ReportedMember& member);

}  // namespace twincraft
