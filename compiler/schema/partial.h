// JSON Schema of a spec that may be only a part of one, because it extends another: then nothing is
// required, and `null` may stand wherever a key is to be taken away.
// Tested by tests/compiler/schema_test.cpp.
#pragma once

#include <nlohmann/json.hpp>

namespace twincraft {

/// @param whole  the schema of a complete spec, as Table::schema() gives it
/// @return a schema that demands everything `whole` does, unless the spec has the key `extends`
nlohmann::ordered_json whole_unless_extending(const nlohmann::ordered_json& whole);

}  // namespace twincraft
