// The typed half of field tables: members in, members out. Included by table.h alone.
// Tested by tests/compiler/schema_test.cpp.
#pragma once

namespace twincraft {

template <class T, class V>
Field<T> required(std::string key, V T::*member, Kind<V> kind, std::string doc) {
  FieldAccess<T> access;
  access.read = [member, read = std::move(kind.read)](const Node& node, ReadContext& context,
                                                      T& into) {
    std::optional<V> value = read(node, context);
    if (value) into.*member = std::move(*value);
    return value.has_value();
  };
  access.write = [member, write = std::move(kind.write)](const T& from) {
    return write(from.*member);
  };
  return {required_field(std::move(key), std::move(doc), std::move(kind.text),
                         std::move(kind.schema), std::move(kind.tables)),
          std::move(access)};
}

template <class T, class V>
Field<T> optional(std::string key, V T::*member, Kind<V> kind, std::string doc) {
  Field<T> field = required(std::move(key), member, std::move(kind), std::move(doc));
  make_optional(field.info, field.access.write(T{}));
  return field;
}

template <class T>
Table<T>::Table(std::string name, std::string doc, std::vector<Field<T>> fields)
    : info_{.name = std::move(name), .doc = std::move(doc), .fields = {}, .groups = {}} {
  for (Field<T>& field : fields) {
    info_.fields.push_back(std::move(field.info));
    access_.push_back(std::move(field.access));
  }
}

template <class T>
Table<T> Table<T>::exactly_one_of(std::vector<std::string> keys) && {
  add_group(info_, {.keys = std::move(keys), .required = true});
  return std::move(*this);
}

template <class T>
Table<T> Table<T>::at_most_one_of(std::vector<std::string> keys) && {
  add_group(info_, {.keys = std::move(keys), .required = false});
  return std::move(*this);
}

template <class T>
bool Table<T>::fill(T& value, const Node& node, const ReadContext& outer) const {
  if constexpr (std::is_base_of_v<Written, T>) value.node = &node;
  bool good = check_keys(info_, node, outer);
  for (std::size_t i = 0; i < access_.size(); ++i) {
    const std::string& key = info_.fields[i].key;
    const Node* item = node.find(key);
    if (item == nullptr) continue;
    ReadContext context = field_context(info_, key, node, outer);
    good = access_[i].read(*item, context, value) && good;
  }
  return good;
}

template <class T>
T Table<T>::read(const Node& node, Diagnostics& diagnostics) const {
  T value{};
  fill(value, node, ReadContext{.diagnostics = diagnostics, .where = {}});
  return value;
}

template <class T>
std::optional<T> Table<T>::read_inside(const Node& node, const ReadContext& outer) const {
  std::optional<T> value(std::in_place);
  if (!fill(*value, node, outer)) return std::nullopt;
  return value;
}

template <class T>
Json Table<T>::schema() const {
  return schema_of(info_);
}

template <class T>
Json Table<T>::write(const T& value) const {
  std::vector<Json> items;
  for (const FieldAccess<T>& access : access_) items.push_back(access.write(value));
  return written_map(info_, std::move(items));
}

template <class T>
Kind<T> object(const Table<T>& table) {
  return {
      .text = table.name(),
      .schema = table.schema(),
      .read = [&table](const Node& node,
                       ReadContext& context) { return table.read_inside(node, context); },
      .write = [&table](const T& value) { return table.write(value); },
      .tables = {&table.info()},
  };
}

}  // namespace twincraft
