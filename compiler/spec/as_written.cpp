// See as_written.h.
#include "compiler/spec/as_written.h"

#include <utility>

#include "compiler/schema/own_kind.h"

namespace twincraft {

Json json_of(const Node& node) {
  switch (node.kind) {
    case Node::Kind::kNull:
      return nullptr;
    case Node::Kind::kScalar: {
      Json number =
          node.quoted ? Json(Json::value_t::discarded) : Json::parse(node.scalar, nullptr, false);
      return number.is_number() ? number : Json(node.scalar);
    }
    case Node::Kind::kList: {
      Json list = Json::array();
      for (const Node& item : node.items) list.push_back(json_of(item));
      return list;
    }
    case Node::Kind::kMap:
      break;
  }
  Json map = Json::object();
  for (std::size_t i = 0; i < node.keys.size(); ++i)
    map[node.keys[i].name] = json_of(node.items[i]);
  return map;
}

Kind<Node> any_value() {
  return own_kind<Node>({
      .text = "value",
      .schema = Json::object(),
      .read = [](const Node& node, ReadContext&) -> std::optional<Node> { return node; },
      .write = json_of,
  });
}

Kind<Node> any_quantity(std::string text) {
  return own_kind<Node>({
      .text = std::move(text),
      .schema = any_of({{"type", "number"}}, {{"type", "string"}}),
      .read = [](const Node& node, ReadContext& context) -> std::optional<Node> {
        if (scalar_text(node, context, "a quantity", "write for example `0.5`") == nullptr)
          return std::nullopt;
        return node;
      },
      .write = json_of,
  });
}

Span path_span(const Written& where) {
  const Node* node = where.node->find("set");
  Span span = node->span;
  if (node->quoted) {
    span.column += 1;
    span.length -= 2;
  }
  return span;
}

}  // namespace twincraft
