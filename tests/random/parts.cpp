// See parts.h.
#include "tests/random/parts.h"

#include <cstddef>
#include <utility>

namespace twincraft::random_vehicles {
namespace {

bool is_named_list(const Json& value) {
  return value.is_array() && !value.empty() && value[0].is_object() && value[0].contains("name");
}

/// The first half stays in the base; its first member is itself dealt.
Parts deal_list(const Json& list) {
  Parts parts{Json::array(), Json::array()};
  const std::size_t half = (list.size() + 1) / 2;
  for (std::size_t i = 0; i < half; ++i) parts.base.push_back(list[i]);
  Parts first = deal(list[0]);
  parts.base[0] = std::move(first.base);
  parts.rest.push_back(std::move(first.rest));
  for (std::size_t i = half; i < list.size(); ++i) parts.rest.push_back(list[i]);
  return parts;
}

}  // namespace

Parts deal(const Json& spec) {
  Parts parts{Json::object(), Json::object()};
  std::size_t turn = 0;
  for (const auto& [key, value] : spec.items()) {
    if (key == "name" || key == "format") {
      parts.base[key] = parts.rest[key] = value;
    } else if (value.is_object() || is_named_list(value)) {
      Parts inner = value.is_object() ? deal(value) : deal_list(value);
      if (!inner.base.empty()) parts.base[key] = std::move(inner.base);
      if (!inner.rest.empty()) parts.rest[key] = std::move(inner.rest);
    } else {
      ++turn;
      if (turn % 2 == 0) parts.rest[key] = value;
      if (turn % 2 == 1) parts.base[key] = value;
      // Numbers and plain lists that the other part replaces.
      if (turn % 4 == 0) parts.base[key] = value.is_array() ? Json{1, 2} : Json("-1 furlong");
    }
  }
  return parts;
}

}  // namespace twincraft::random_vehicles
