// A model as a Python script for Basilisk. It needs Basilisk and numpy alone, and flies the vehicle
// in both of Basilisk's formulations of its dynamics, as far as each of them can express it.
#pragma once

#include <nlohmann/json.hpp>

#include "compiler/emit/printed.h"
#include "compiler/ir/model.h"

namespace twincraft {

/// Refused where neither formulation can express the vehicle. Remarks: what one of them cannot
/// express, and what is written otherwise than in the spec.
/// @param resolved  the map that the spec's field table writes
Printed emit_basilisk(const Model& model, const nlohmann::ordered_json& resolved);

}  // namespace twincraft
