// How a kind is made that is no combination of others. Apart from kind.h, because whoever includes
// this pays for JSON.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compiler/schema/kind.h"

namespace twincraft {

/// What AnyKind shares. A value is behind a pointer to the type that the maker knows.
struct KindBody {
  KindBody(std::string words, Json fragment, std::vector<const TableInfo*> maps, Numbers made_of)
      : text(std::move(words)),
        schema(std::move(fragment)),
        tables(std::move(maps)),
        numbers(std::move(made_of)) {}
  KindBody(const KindBody&) = delete;
  KindBody& operator=(const KindBody&) = delete;
  virtual ~KindBody() = default;

  virtual bool read(void* value, const Node& node, ReadContext& context) const = 0;
  /// See AnyKind::reread_into. What is not made of parts is read whole.
  virtual bool reread(void* value, const Node& node, [[maybe_unused]] const Node& before,
                      ReadContext& context) const {
    return read(value, node, context);
  }
  virtual Json write(const void* value) const = 0;

  const std::string text;
  const Json schema;
  const std::vector<const TableInfo*> tables;
  const Numbers numbers;
};

template <class V>
struct KindParts {
  std::string text;
  Json schema;
  std::function<std::optional<V>(const Node&, ReadContext&)> read;
  std::function<Json(const V&)> write;
  std::vector<const TableInfo*> tables = {};
  Numbers numbers = {};
};

template <class V>
class OwnKind : public KindBody {
 public:
  explicit OwnKind(KindParts<V> parts)
      : KindBody(std::move(parts.text), std::move(parts.schema), std::move(parts.tables),
                 std::move(parts.numbers)),
        read_(std::move(parts.read)),
        write_(std::move(parts.write)) {}

  bool read(void* value, const Node& node, ReadContext& context) const override {
    std::optional<V> result = read_(node, context);
    if (result) *static_cast<V*>(value) = std::move(*result);
    return result.has_value();
  }
  Json write(const void* value) const override { return write_(*static_cast<const V*>(value)); }

 private:
  std::function<std::optional<V>(const Node&, ReadContext&)> read_;
  std::function<Json(const V&)> write_;
};

template <class V>
Kind<V> own_kind(KindParts<V> parts) {
  return Kind<V>(AnyKind(std::make_shared<OwnKind<V>>(std::move(parts))));
}

}  // namespace twincraft
