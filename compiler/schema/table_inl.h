// The typed half of field tables: where members are. Included by table.h alone.
// Tested by tests/compiler/schema_test.cpp.
#pragma once

namespace twincraft {

/// From the beginning of `whole` to `part`, which is in it.
inline std::size_t offset_in(const void* whole, const void* part) {
  return static_cast<std::size_t>(static_cast<const char*>(part) - static_cast<const char*>(whole));
}

template <class T, class V>
Field<T> required(std::string_view key, V T::*member, const Kind<V>& kind, std::string_view doc) {
  const T value{};
  return {{key, doc, kind, offset_in(&value, &(value.*member)), true}};
}

template <class T, class V>
Field<T> optional(std::string_view key, V T::*member, const Kind<V>& kind, std::string_view doc) {
  Field<T> field = required(key, member, kind, doc);
  field.required = false;
  return field;
}

template <class T>
AnyTable::Access access_of() {
  AnyTable::Access access{{}, [](void* value) { *static_cast<T*>(value) = T{}; }};
  const T value{};
  if constexpr (std::is_base_of_v<Written, T>)
    access.written = offset_in(&value, static_cast<const Written*>(&value));
  return access;
}

template <class T>
Table<T>::Table(std::string_view name, std::string_view doc, std::span<const Field<T>> fields)
    : AnyTable(name, doc, access_of<T>()) {
  const T defaults{};
  for (const Field<T>& field : fields) add(field, &defaults);
}

template <class T>
Table<T>::Table(std::string_view name, std::string_view doc, std::initializer_list<Field<T>> fields)
    : Table(name, doc, std::span<const Field<T>>(fields.begin(), fields.size())) {}

template <class T>
Table<T> Table<T>::exactly_one_of(std::vector<std::string> keys) && {
  add_group(std::move(keys), true);
  return *this;
}

template <class T>
Table<T> Table<T>::at_most_one_of(std::vector<std::string> keys) && {
  add_group(std::move(keys), false);
  return *this;
}

template <class T>
T Table<T>::read(const Node& node, Diagnostics& diagnostics) const {
  T value{};
  fill(&value, node, ReadContext{.diagnostics = diagnostics, .where = {}});
  return value;
}

template <class T>
T Table<T>::reread(T value, const Node& node, const Node& before, Diagnostics& diagnostics) const {
  refill(&value, node, before, ReadContext{.diagnostics = diagnostics, .where = {}});
  return value;
}

template <class T>
std::optional<T> Table<T>::read_inside(const Node& node, const ReadContext& outer) const {
  std::optional<T> value(std::in_place);
  if (!fill(&*value, node, outer)) return std::nullopt;
  return value;
}

}  // namespace twincraft
