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

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

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

/// A key and the member that it fills. Only lives until its table has taken it in.
struct AnyField {
  std::string_view key;
  std::string_view doc;
  AnyKind kind;
  std::size_t offset = 0;  // of the member in its struct
  bool required = false;
};

template <class T>
struct Field : AnyField {};

/// Must be written.
template <class T, class V>
Field<T> required(std::string_view key, V T::*member, const Kind<V>& kind, std::string_view doc);
/// May be left out: the member's initialiser is the default. A std::optional member (with a
/// maybe(...) kind), an empty list and an empty text have none.
template <class T, class V>
Field<T> optional(std::string_view key, V T::*member, const Kind<V>& kind, std::string_view doc);

/// A table of which the struct is not known: all that is compiled once. Copies share one body.
class AnyTable {
 public:
  /// What must be known of the struct.
  struct Access {
    std::optional<std::size_t> written;  // offset of its base Written; nothing: it has none
    void (*reset)(void* value);          // all members to their initialisers
  };
  AnyTable(std::string_view name, std::string_view doc, Access access);
  AnyTable(const AnyTable&);
  AnyTable& operator=(const AnyTable&);
  ~AnyTable();

  const TableInfo& info() const;
  const std::string& name() const;
  Json schema() const;  // a closed object with descriptions, defaults and required keys

  /// Read the members that are written; the others stay. @return whether there was no fault
  bool fill(void* value, const Node& node, const ReadContext& outer) const;
  /// The same for a value that was read from `before` without a diagnostic: see
  /// AnyKind::reread_into.
  bool refill(void* value, const Node& node, const Node& before, const ReadContext& outer) const;
  void reset(void* value) const;
  Json write_from(const void* value) const;
  Json write_key_from(const void* value, std::string_view key) const;

 protected:
  /// @param defaults  a value with all members at their initialisers
  void add(const AnyField& field, const void* defaults);
  void add_group(std::vector<std::string> keys, bool required);

 private:
  /// @param before  null: nothing was read before
  bool read_members(void* value, const Node& node, const Node* before,
                    const ReadContext& outer) const;

  struct Body;
  std::shared_ptr<Body> body_;
};

template <class T>
class Table : public AnyTable {
 public:
  Table(std::string_view name, std::string_view doc, std::initializer_list<Field<T>> fields);
  Table(std::string_view name, std::string_view doc, std::span<const Field<T>> fields);

  /// Exactly one of these keys must be written; each of them is an optional field.
  Table exactly_one_of(std::vector<std::string> keys) &&;
  /// At most one of these keys may be written.
  Table at_most_one_of(std::vector<std::string> keys) &&;

  /// Read a map: unknown keys (with the nearest known one as hint), missing required keys, and
  /// every fault of every value are reported. The struct is complete only when no error was added.
  T read(const Node& node, Diagnostics& diagnostics) const;
  /// What `read` would give, made of `value`, which it gave for `before` without a diagnostic. What
  /// `node` does not change is not read again, and goes on pointing into `before`.
  T reread(T value, const Node& node, const Node& before, Diagnostics& diagnostics) const;
  /// As `read`, of a map inside another one; nothing when there was a fault.
  std::optional<T> read_inside(const Node& node, const ReadContext& outer) const;
  /// A template, so that Json need be complete for callers alone.
  template <class Result = Json>
  Result write(const T& value) const {
    return write_from(&value);
  }
  /// What `write` has at `key`, defaults included; null when there is no such key.
  template <class Result = Json>
  Result write_key(const T& value, std::string_view key) const {
    return write_key_from(&value, key);
  }
};

AnyKind object_kind(const AnyTable& table);

/// A nested map.
template <class T>
Kind<T> object(const Table<T>& table) {
  return Kind<T>(object_kind(table));
}

}  // namespace twincraft

#include "compiler/schema/table_inl.h"
