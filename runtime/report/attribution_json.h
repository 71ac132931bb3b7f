// Attributions as the report has them. Tested by tests/runtime/attribution_test.cpp.
#pragma once

#include <nlohmann/json.hpp>

#include "compiler/ir/model.h"
#include "runtime/study/attribution.h"

namespace twincraft {

/// One object per cause, by share.
nlohmann::ordered_json attribution_json(const Attribution& attribution);

/// What was explained, what is left, and the conclusion.
nlohmann::ordered_json explanation_json(const Attribution& attribution, const Model& model);

}  // namespace twincraft
