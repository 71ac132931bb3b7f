// The kinds that combine other kinds: what is done to a list, an optional or a variant of a type,
// as functions that do not show the type. Included by kind.h alone. Tested by
// tests/compiler/kind_test.cpp.
#pragma once

#include <cstddef>

namespace twincraft {

/// Words and what they mean, as numbers.
struct WordAccess {
  void (*store)(void* value, std::int64_t meaning);
  std::int64_t (*load)(const void* value);
};
AnyKind words_kind(std::vector<std::pair<std::string, std::int64_t>> words, WordAccess access);

template <class E>
Kind<E> one_of(const std::vector<std::pair<std::string_view, E>>& words) {
  std::vector<std::pair<std::string, std::int64_t>> meanings;
  for (const auto& [word, value] : words)
    meanings.emplace_back(word, static_cast<std::int64_t>(value));
  return Kind<E>(words_kind(
      std::move(meanings),
      {[](void* value, std::int64_t meaning) { *static_cast<E*>(value) = static_cast<E>(meaning); },
       [](const void* value) {
         return static_cast<std::int64_t>(*static_cast<const E*>(value));
       }}));
}

struct ListAccess {
  void (*clear)(void* list);
  void* (*append)(void* list);  // an item to be read into
  std::size_t (*size)(const void* list);
  const void* (*item)(const void* list, std::size_t index);
  void* (*edit)(void* list, std::size_t index);
};
AnyKind list_kind(const AnyKind& item, std::size_t minimum, std::size_t maximum, ListAccess access);
AnyKind one_or_list_kind(const AnyKind& item, ListAccess access);

template <class V>
ListAccess list_access() {
  using List = std::vector<V>;
  return {[](void* list) { static_cast<List*>(list)->clear(); },
          [](void* list) -> void* { return &static_cast<List*>(list)->emplace_back(); },
          [](const void* list) { return static_cast<const List*>(list)->size(); },
          [](const void* list, std::size_t index) -> const void* {
            return static_cast<const List*>(list)->data() + index;
          },
          [](void* list, std::size_t index) -> void* {
            return static_cast<List*>(list)->data() + index;
          }};
}

template <class V>
Kind<std::vector<V>> list_of(const Kind<V>& item, std::size_t minimum, std::size_t maximum) {
  return Kind<std::vector<V>>(list_kind(item, minimum, maximum, list_access<V>()));
}

template <class V>
Kind<std::vector<V>> one_or_list(const Kind<V>& item) {
  return Kind<std::vector<V>>(one_or_list_kind(item, list_access<V>()));
}

struct OptionalAccess {
  void (*reset)(void* optional);
  void* (*emplace)(void* optional);
  const void* (*get)(const void* optional);  // null: nothing
  void* (*edit)(void* optional);             // the same
};
AnyKind maybe_kind(const AnyKind& kind, OptionalAccess access);

template <class V>
Kind<std::optional<V>> maybe(const Kind<V>& kind) {
  using Optional = std::optional<V>;
  return Kind<Optional>(maybe_kind(
      kind, {[](void* optional) { static_cast<Optional*>(optional)->reset(); },
             [](void* optional) -> void* { return &static_cast<Optional*>(optional)->emplace(); },
             [](const void* optional) -> const void* {
               const auto& value = *static_cast<const Optional*>(optional);
               return value ? &*value : nullptr;
             },
             [](void* optional) -> void* {
               auto& value = *static_cast<Optional*>(optional);
               return value ? &*value : nullptr;
             }}));
}

struct VariantAccess {
  void* (*emplace_first)(void* variant);
  void* (*emplace_second)(void* variant);
  const void* (*first)(const void* variant);  // null: it holds the other one
  const void* (*second)(const void* variant);
};
AnyKind either_kind(bool (*suits)(const Node&), const AnyKind& first, const AnyKind& second,
                    VariantAccess access);

template <class A, class B>
Kind<std::variant<A, B>> either(bool (*suits)(const Node&), const Kind<A>& first,
                                const Kind<B>& second) {
  using Variant = std::variant<A, B>;
  return Kind<Variant>(either_kind(suits, first, second,
                                   {[](void* variant) -> void* {
                                      return &static_cast<Variant*>(variant)->template emplace<0>();
                                    },
                                    [](void* variant) -> void* {
                                      return &static_cast<Variant*>(variant)->template emplace<1>();
                                    },
                                    [](const void* variant) -> const void* {
                                      return std::get_if<0>(static_cast<const Variant*>(variant));
                                    },
                                    [](const void* variant) -> const void* {
                                      return std::get_if<1>(static_cast<const Variant*>(variant));
                                    }}));
}

}  // namespace twincraft
