// What a model can be written as. The one table: sccompile, bundles and reports go by it, and a new
// target is a row and the function that prints it.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "compiler/emit/printed.h"
#include "compiler/ir/model.h"

namespace twincraft {

struct Target {
  std::string_view name;    // as `--emit`, bundles and reports call it
  std::string_view suffix;  // of its file, after the vehicle's name
  std::string_view what;    // for `--help`
  /// @param resolved  the map that the spec's field table writes
  Printed (*print)(const Model& model, const nlohmann::ordered_json& resolved);
};

std::span<const Target> targets();

/// Nothing when no target has that name.
const Target* find_target(std::string_view name);

}  // namespace twincraft
