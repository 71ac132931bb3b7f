// The kinds that combine other kinds. Included by kind.h alone.
// Tested by tests/compiler/kind_test.cpp.
#pragma once

#include <algorithm>

namespace twincraft {

template <class E>
Kind<E> one_of(std::vector<std::pair<std::string, E>> words) {
  std::vector<std::string> spellings;
  for (const auto& [word, value] : words) spellings.push_back(word);
  return {
      .text = words_text(spellings, "or"),
      .schema = {{"enum", spellings}},
      .read = [words, spellings](const Node& node, ReadContext& context) -> std::optional<E> {
        const std::optional<std::size_t> index = read_word(node, context, spellings);
        if (!index) return std::nullopt;
        return words[*index].second;
      },
      .write = [words](const E& value) -> Json {
        for (const auto& [word, meaning] : words)
          if (meaning == value) return word;
        return nullptr;
      },
  };
}

template <class V>
Kind<std::vector<V>> list_of(Kind<V> item, std::size_t minimum, std::size_t maximum) {
  return {
      .text = "list of " + item.text,
      .schema = list_schema(item.schema, minimum, maximum),
      .read = [read = item.read, minimum, maximum](
                  const Node& node, ReadContext& context) -> std::optional<std::vector<V>> {
        if (!check_list(node, context, minimum, maximum, "a list")) return std::nullopt;
        std::vector<V> values;
        for (std::size_t i = 0; i < node.items.size(); ++i) {
          ReadContext at_item = item_of(context, i);
          std::optional<V> value = read(node.items[i], at_item);
          if (value) values.push_back(std::move(*value));
        }
        if (values.size() != node.items.size()) return std::nullopt;
        return values;
      },
      .write = [write = item.write](const std::vector<V>& values) -> Json {
        Json list = Json::array();
        for (const V& value : values) list.push_back(write(value));
        return list;
      },
      .tables = item.tables,
  };
}

template <class V>
Kind<std::vector<V>> one_or_list(Kind<V> item) {
  const Kind<std::vector<V>> list = list_of(item, 1);
  return {
      .text = item.text + ", or a list of them",
      .schema = any_of(item.schema, list.schema),
      .read = [read = item.read, read_list = list.read](
                  const Node& node, ReadContext& context) -> std::optional<std::vector<V>> {
        if (node.is_list()) return read_list(node, context);
        std::optional<V> value = read(node, context);
        if (!value) return std::nullopt;
        return std::vector<V>{std::move(*value)};
      },
      .write = [write = item.write, write_list = list.write](const std::vector<V>& values) -> Json {
        return values.size() == 1 ? write(values.front()) : write_list(values);
      },
      .tables = item.tables,
  };
}

template <class V>
Kind<std::optional<V>> maybe(Kind<V> kind) {
  return {
      .text = kind.text,
      .schema = kind.schema,
      .read = [read = kind.read](const Node& node,
                                 ReadContext& context) -> std::optional<std::optional<V>> {
        std::optional<V> value = read(node, context);
        if (!value) return std::nullopt;
        return std::optional<std::optional<V>>(std::in_place, std::move(value));
      },
      .write = [write = kind.write](const std::optional<V>& value) -> Json {
        return value ? write(*value) : Json(nullptr);
      },
      .tables = kind.tables,
  };
}

template <class A, class B>
Kind<std::variant<A, B>> either(std::function<bool(const Node&)> suits, Kind<A> first,
                                Kind<B> second) {
  using Value = std::variant<A, B>;
  return {
      .text = first.text + ", or " + second.text,
      .schema = any_of(first.schema, second.schema),
      .read = [suits, read_first = first.read, read_second = second.read](
                  const Node& node, ReadContext& context) -> std::optional<Value> {
        if (suits(node)) {
          std::optional<A> value = read_first(node, context);
          if (!value) return std::nullopt;
          return Value(std::in_place_index<0>, std::move(*value));
        }
        std::optional<B> value = read_second(node, context);
        if (!value) return std::nullopt;
        return Value(std::in_place_index<1>, std::move(*value));
      },
      .write = [write_first = first.write,
                write_second = second.write](const Value& value) -> Json {
        return value.index() == 0 ? write_first(std::get<0>(value))
                                  : write_second(std::get<1>(value));
      },
      .tables = joined(first.tables, second.tables),
  };
}

template <class V, class From, class To>
Kind<std::invoke_result_t<From, V>> map(Kind<V> kind, From from, To to) {
  using W = std::invoke_result_t<From, V>;
  return {
      .text = kind.text,
      .schema = kind.schema,
      .read = [read = kind.read, from](const Node& node, ReadContext& context) -> std::optional<W> {
        std::optional<V> value = read(node, context);
        if (!value) return std::nullopt;
        return from(std::move(*value));
      },
      .write = [write = kind.write, to](const W& value) -> Json { return write(to(value)); },
      .tables = kind.tables,
  };
}

}  // namespace twincraft
