// Looking into the syntax tree. Tested by tests/compiler/load_test.cpp.
#include "compiler/syntax/node.h"

#include <algorithm>

#include "compiler/diag/diagnostics.h"

namespace twincraft {

const Node* Node::find(std::string_view key) const {
  const auto found = std::ranges::find(keys, key, &Key::name);
  return found == keys.end() ? nullptr : &items[static_cast<std::size_t>(found - keys.begin())];
}

Node* Node::find(std::string_view key) {
  return const_cast<Node*>(static_cast<const Node*>(this)->find(key));
}

std::string describe(const Node& node) {
  switch (node.kind) {
    case Node::Kind::kNull:
      return "nothing";
    case Node::Kind::kScalar:
      return in_backticks(node.scalar);
    case Node::Kind::kList:
      return "a list";
    case Node::Kind::kMap:
      break;
  }
  return "a map";
}

}  // namespace twincraft
