// The verdict on a run's resolution, as in report.json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "runtime/study/member.h"

namespace twincraft {

/// Numbers without meaning are null. @pre member.resolution
nlohmann::ordered_json resolution_json(const Member& member);

}  // namespace twincraft
