// What the language says of a map and its keys, whatever struct it fills: for the reader, the
// schema and the reference. Tested by tests/compiler/schema_test.cpp.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/schema/reading.h"

namespace twincraft {

struct FieldInfo {
  std::string key;
  std::string doc;   // one or two sentences: meaning, and the default in words if it has no value
  std::string kind;  // AnyKind::text
  bool required = false;
  Json schema;
  std::optional<Json> default_value;  // as it would be written; nothing: absent or required
  std::vector<const TableInfo*> tables;
  Numbers numbers = {};
};

/// Keys of one map of which only one may be written, or exactly one must be.
struct KeyGroup {
  std::vector<std::string> keys;
  bool required = false;
};

struct TableInfo {
  std::string name;  // "wheel": how messages call one of these
  std::string doc;
  std::vector<FieldInfo> fields;
  std::vector<KeyGroup> groups;
};

/// The field of `key`; null when there is none.
const FieldInfo* find_field(const TableInfo& info, std::string_view key);
/// "wheel `rw_x`", "hinge of panel `wing_p`", "hub": how messages call this map.
std::string label_of(const TableInfo& info, const Node& map, const ReadContext& outer);
/// Whether `map` is one and has the keys it should; what is wrong is reported.
bool check_keys(const TableInfo& info, const Node& map, const ReadContext& outer);
/// The context of the value of `key` in `map`.
ReadContext field_context(const TableInfo& info, const std::string& key, const Node& map,
                          const ReadContext& outer);
FieldInfo required_field(std::string key, std::string doc, std::string kind, Json schema,
                         std::vector<const TableInfo*> tables);
/// The field may be left out, which means `default_value` unless that is nothing.
void make_optional(FieldInfo& field, Json default_value);
/// Add a group; its keys must be fields that are not required by themselves.
void add_group(TableInfo& info, KeyGroup group);
Json schema_of(const TableInfo& info);
/// The map with these values of all fields, less what is nothing and the defaults whose key
/// excludes one that is there: reading it again would find both.
Json written_map(const TableInfo& info, std::vector<Json> values);
/// Null, "", [] and {}: values that are left out.
bool is_nothing(const Json& value);

}  // namespace twincraft
