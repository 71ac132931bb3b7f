// The resolved spec as YAML: every default filled in, SI units, canonical words. Compiles to the
// same bytes as the spec it came from. Tested by tests/compiler/emit_test.cpp.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace twincraft {

/// @param spec  the map that the spec's field table writes
std::string emit_resolved(const nlohmann::ordered_json& spec);

}  // namespace twincraft
