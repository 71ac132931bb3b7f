// The syntax tree of a spec: what was written and where, before it means anything.
// Tested by tests/compiler/load_test.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compiler/diag/source.h"

namespace twincraft {

struct Node {
  enum class Kind { kNull, kScalar, kList, kMap };
  struct Key {
    std::string name;
    Span span;

    bool operator==(const Key&) const = default;
  };

  Kind kind = Kind::kNull;
  Span span;                // scalar: the token; list and map: where it begins
  std::string scalar;       // kScalar
  bool quoted = false;      // kScalar: written in quotes
  std::vector<Key> keys;    // kMap: keys[i] belongs to items[i]
  std::vector<Node> items;  // kList, kMap

  /// The same text at the same place.
  bool operator==(const Node&) const = default;

  bool is_null() const { return kind == Kind::kNull; }
  bool is_scalar() const { return kind == Kind::kScalar; }
  bool is_list() const { return kind == Kind::kList; }
  bool is_map() const { return kind == Kind::kMap; }

  /// The value of `key`, or null. Only for maps already known to be small or looked up once.
  const Node* find(std::string_view key) const;
  Node* find(std::string_view key);
};

/// "a map", "a list", "`text`" for messages.
std::string describe(const Node& node);

}  // namespace twincraft
