// A model as a Python script for Basilisk. It needs Basilisk and numpy alone, and flies the vehicle
// in both of Basilisk's formulations of its dynamics, as far as each of them can express it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compiler/emit/remark.h"
#include "compiler/ir/model.h"

namespace twincraft {

/// @param resolved  the map that the spec's field table writes
std::string emit_basilisk(const Model& model, const nlohmann::ordered_json& resolved);

/// Why neither formulation can express the vehicle; none: one can.
std::string basilisk_refusal(const Model& model);

/// What one formulation cannot express, and what is written otherwise than in the spec.
std::vector<Remark> basilisk_remarks(const Model& model);

}  // namespace twincraft
