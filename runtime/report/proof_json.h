// The proof of `sccompile --check` for programs, format `twincraft-proof/1`.
// Tested by tests/runtime/delivery_test.cpp.
#pragma once

#include <string>
#include <string_view>

#include "runtime/compare/proof.h"

namespace twincraft {

/// Numbers that are not finite are null.
/// @param name  of the spec
std::string proof_json(const ProofReport& report, std::string_view name);

}  // namespace twincraft
