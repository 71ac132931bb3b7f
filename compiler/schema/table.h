// Field tables: the keys of one section of the language, once. Reader, JSON Schema, reference text
// and resolved output all walk the same table; a default is the struct's own member initialiser.
//
//   struct WheelSpec : Written { std::string name; double mass = 0.0; ... };
//   const Table<WheelSpec>& wheel_table() {
//     static const Table<WheelSpec> table{"wheel", "A balanced reaction wheel.", {
//         required("name", &WheelSpec::name, name(), "unique in the file"),
//         optional("mass", &WheelSpec::mass, quantity("kg", Range::kNotNegative), "0: carried..."),
//     }};
//     return table;
//   }
//
// Keys that exclude each other: `static const auto table = Table<AttitudeSpec>{...}
// .exactly_one_of({"quaternion", "mrp", "euler"});`. Tested by tests/compiler/schema_test.cpp.
#pragma once

#include "compiler/schema/kind.h"

namespace twincraft {

/// Base of every struct that is read from a map: remembers where it was written, so that later
/// stages can point at it.
struct Written {
  const Node* node = nullptr;  // null: the section was absent and all defaults hold

  /// The value of `key`, or the map itself when the key was not written.
  Span span_of(std::string_view key) const;
  Span span() const;
  bool has(std::string_view key) const;
};

/// What the language says of one key, whatever member it fills. Every table copies some: copying
/// and destroying them is compiled once.
struct FieldInfo {
  FieldInfo();
  FieldInfo(const FieldInfo&);
  FieldInfo(FieldInfo&&) noexcept;
  FieldInfo& operator=(const FieldInfo&);
  FieldInfo& operator=(FieldInfo&&) noexcept;
  ~FieldInfo();

  std::string key;
  std::string doc;   // one or two sentences: meaning, and the default in words if it has no value
  std::string kind;  // Kind::text
  bool required = false;
  Json schema;
  std::optional<Json> default_value;  // as it would be written; nothing: absent or required
  std::vector<const TableInfo*> tables;
};

/// Keys of one map of which only one may be written, or exactly one must be.
struct KeyGroup {
  std::vector<std::string> keys;
  bool required = false;
};

/// What the language says of one sort of map, whatever struct it fills.
struct TableInfo {
  std::string name;  // "wheel": how messages call one of these
  std::string doc;
  std::vector<FieldInfo> fields;
  std::vector<KeyGroup> groups;
};

template <class T>
struct FieldAccess {
  std::function<bool(const Node&, ReadContext&, T&)> read;  // whether there was no fault
  std::function<Json(const T&)> write;                      // null: nothing to write
};

template <class T>
struct Field {
  FieldInfo info;
  FieldAccess<T> access;
};

/// Must be written.
template <class T, class V>
Field<T> required(std::string key, V T::*member, Kind<V> kind, std::string doc);
/// May be left out: the member's initialiser is the default. A std::optional member (with a
/// maybe(...) kind), an empty list and an empty text have none.
template <class T, class V>
Field<T> optional(std::string key, V T::*member, Kind<V> kind, std::string doc);

template <class T>
class Table {
 public:
  Table(std::string name, std::string doc, std::vector<Field<T>> fields);

  /// Exactly one of these keys must be written; each of them is an optional field.
  Table exactly_one_of(std::vector<std::string> keys) &&;
  /// At most one of these keys may be written.
  Table at_most_one_of(std::vector<std::string> keys) &&;

  const TableInfo& info() const { return info_; }
  const std::string& name() const { return info_.name; }
  const std::string& doc() const { return info_.doc; }
  const std::vector<FieldInfo>& fields() const { return info_.fields; }

  /// Read a map: unknown keys (with the nearest known one as hint), missing required keys, and
  /// every fault of every value are reported. The struct is complete only when no error was added.
  T read(const Node& node, Diagnostics& diagnostics) const;
  /// The same for a map inside another one; nothing when there was a fault.
  std::optional<T> read_inside(const Node& node, const ReadContext& outer) const;
  Json schema() const;  // a closed object with descriptions, defaults and required keys
  Json write(const T& value) const;

 private:
  bool fill(T& value, const Node& node, const ReadContext& outer) const;

  TableInfo info_;
  std::vector<FieldAccess<T>> access_;  // parallel to info_.fields
};

/// A nested map. The table must outlive the kind, as function-local statics do.
template <class T>
Kind<T> object(const Table<T>& table);
template <class T>
Kind<T> object(const Table<T>&& table) = delete;

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

#include "compiler/schema/table_inl.h"
