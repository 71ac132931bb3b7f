// One syntax tree on top of another; see extends.h for the rules. Every node of the result is one
// of those given, so its place stays that of its own file.
// Tested by tests/compiler/extends_test.cpp.
#include <algorithm>
#include <unordered_map>

#include "compiler/syntax/extends.h"
#include "compiler/syntax/scan.h"

namespace twincraft {
namespace {

/// The name of a list's member; empty when it has none.
std::string name_of(const Node& member) {
  const Node* name = member.is_map() ? member.find("name") : nullptr;
  return name != nullptr && name->is_scalar() ? name->scalar : std::string();
}

bool has_names(const Node& list) {
  const auto is_nameless = [](const Node& member) { return name_of(member).empty(); };
  return list.is_list() && !list.items.empty() && std::ranges::none_of(list.items, is_nameless);
}

/// `null` that was written, not a value that was forgotten.
bool takes_away(const Node& value) {
  if (!value.is_null() || value.span.source == nullptr) return false;
  const std::string_view line = value.span.source->line(value.span.line);
  return length_of_null(line, static_cast<std::size_t>(value.span.column) - 1) > 0;
}

void push(Node& map, Node::Key key, Node item) {
  map.keys.push_back(std::move(key));
  map.items.push_back(std::move(item));
}

Node merge_maps(Node base, Node own) {
  std::unordered_map<std::string, std::size_t> place;  // of the keys of `own`
  for (std::size_t i = 0; i < own.keys.size(); ++i) place[own.keys[i].name] = i;
  std::vector<bool> used(own.keys.size());

  Node merged;
  merged.kind = Node::Kind::kMap;
  merged.span = own.span;
  for (std::size_t i = 0; i < base.keys.size(); ++i) {
    const auto found = place.find(base.keys[i].name);
    if (found == place.end()) {
      push(merged, std::move(base.keys[i]), std::move(base.items[i]));
      continue;
    }
    Node& item = own.items[found->second];
    used[found->second] = true;
    if (takes_away(item)) continue;
    push(merged, std::move(own.keys[found->second]),
         merge(std::move(base.items[i]), std::move(item)));
  }
  for (std::size_t i = 0; i < own.keys.size(); ++i) {
    if (!used[i]) push(merged, std::move(own.keys[i]), std::move(own.items[i]));
  }
  return merged;
}

/// A name that occurs twice in one file stays there twice, for the check of names to find.
Node merge_members(Node base, Node own) {
  std::unordered_map<std::string, std::size_t> place;  // of the members of `own`
  for (std::size_t i = 0; i < own.items.size(); ++i) place.emplace(name_of(own.items[i]), i);
  std::vector<bool> used(own.items.size());

  Node merged;
  merged.kind = Node::Kind::kList;
  merged.span = own.span;
  for (Node& member : base.items) {
    const auto found = place.find(name_of(member));
    if (found == place.end() || used[found->second]) {
      merged.items.push_back(std::move(member));
      continue;
    }
    used[found->second] = true;
    merged.items.push_back(merge(std::move(member), std::move(own.items[found->second])));
  }
  for (std::size_t i = 0; i < own.items.size(); ++i) {
    if (!used[i]) merged.items.push_back(std::move(own.items[i]));
  }
  return merged;
}

}  // namespace

Node merge(Node base, Node own) {
  if (base.is_map() && own.is_map()) return merge_maps(std::move(base), std::move(own));
  if (has_names(base) && has_names(own)) return merge_members(std::move(base), std::move(own));
  return own;
}

}  // namespace twincraft
