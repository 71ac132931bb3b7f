// The schema is written twice: for editors with its descriptions and without demands, then with its
// demands and without descriptions for specs that stand alone.
// Tested by tests/compiler/schema_test.cpp.
#include "compiler/schema/partial.h"

#include <functional>
#include <set>

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

/// The members of `properties` are keys of the language, never keywords of JSON Schema.
Json without(const Json& schema, const std::set<std::string>& keywords,
             const std::function<Json(Json)>& on_property) {
  if (schema.is_array()) {
    Json items = Json::array();
    for (const Json& item : schema) items.push_back(without(item, keywords, on_property));
    return items;
  }
  if (!schema.is_object()) return schema;
  Json kept = Json::object();
  for (const auto& [keyword, value] : schema.items()) {
    if (keywords.contains(keyword)) continue;
    if (keyword != "properties") {
      kept[keyword] = without(value, keywords, on_property);
      continue;
    }
    for (const auto& [key, property] : value.items()) {
      kept[keyword][key] = on_property(without(property, keywords, on_property));
    }
  }
  return kept;
}

Json or_null(Json property) {
  if (property.contains("anyOf")) property["anyOf"].push_back({{"type", "null"}});
  if (property.contains("enum")) property["enum"].push_back(nullptr);
  if (property.contains("type")) property["type"] = Json::array({property["type"], "null"});
  return property;
}

}  // namespace

Json whole_unless_extending(const Json& whole) {
  Json schema = without(whole, {"required", "allOf"}, or_null);
  schema["if"] = {{"required", Json::array({"extends"})}};
  schema["else"] =
      without(whole, {"description", "default", "x-unit"}, [](Json property) { return property; });
  return schema;
}

}  // namespace twincraft
