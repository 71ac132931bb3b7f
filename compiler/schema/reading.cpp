// See reading.h. Tested by tests/compiler/kind_test.cpp.
#include "compiler/schema/reading.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "compiler/schema/synonyms.h"

namespace twincraft {
namespace {

std::string count_text(std::size_t minimum, std::size_t maximum) {
  if (minimum == maximum) return fmt::format("exactly {}", minimum);
  if (maximum == kAnyCount) return fmt::format("at least {}", minimum);
  if (minimum == 0) return fmt::format("at most {}", maximum);
  return fmt::format("from {} to {}", minimum, maximum);
}

}  // namespace

void report_wrong_type(const Node& node, ReadContext& context, const std::string& expected,
                       const std::string& hint) {
  if (node.is_null()) {
    context.diagnostics.error(Code::kNoValue, node.span, context.where + " has no value")
        .with_hint("write " + expected + ", or delete it");
    return;
  }
  context.diagnostics
      .error(Code::kWrongType, node.span,
             fmt::format("{} is {}, not {}", context.where, describe(node), expected))
      .with_hint(hint);
}

const std::string* scalar_text(const Node& node, ReadContext& context, const std::string& expected,
                               const std::string& hint) {
  if (node.is_scalar()) return &node.scalar;
  report_wrong_type(node, context, expected, hint);
  return nullptr;
}

bool check_list(const Node& node, ReadContext& context, std::size_t minimum, std::size_t maximum,
                const std::string& expected, const std::string& form) {
  if (!node.is_list()) {
    const std::string of_maps = form.empty() ? "begin every item with `- `" : form;
    report_wrong_type(node, context, expected,
                      node.is_map() ? of_maps : "lists are written `[.., ..]`");
    return false;
  }
  const std::size_t count = node.items.size();
  if (count >= minimum && count <= maximum) return true;
  context.diagnostics.error(count < minimum ? Code::kTooFew : Code::kTooMany, node.span,
                            fmt::format("{} has {} item{}, but must have {}", context.where, count,
                                        count == 1 ? "" : "s", count_text(minimum, maximum)));
  return false;
}

ReadContext part_of(const ReadContext& whole, std::string_view part) {
  return {whole.diagnostics, fmt::format("{} of {}", part, whole.where), whole.owner};
}

ReadContext item_of(const ReadContext& list, std::size_t index) {
  return part_of(list, fmt::format("item {}", index + 1));
}

std::optional<std::size_t> read_word(const Node& node, ReadContext& context,
                                     const std::vector<std::string>& words) {
  const std::string choices = words_text(words, "or");
  const std::string* text = scalar_text(node, context, choices, "write one of these words");
  if (text == nullptr) return std::nullopt;
  for (std::size_t i = 0; i < words.size(); ++i)
    if (words[i] == *text) return i;
  context.diagnostics
      .error(Code::kUnknownWord, node.span,
             fmt::format("{} is {}, not {}", context.where, describe(node), choices))
      .with_hint(hint_for_word(*text, words));
  return std::nullopt;
}

std::string words_text(const std::vector<std::string>& words, std::string_view conjunction) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? fmt::format(" {} ", conjunction) : ", ";
    text += fmt::format("`{}`", words[i]);
  }
  return text;
}

Json list_schema(const Json& item, std::size_t minimum, std::size_t maximum) {
  Json schema = {{"type", "array"}, {"items", item}};
  if (minimum > 0) schema["minItems"] = minimum;
  if (maximum != kAnyCount) schema["maxItems"] = maximum;
  return schema;
}

Json any_of(Json first, Json second) {
  return {{"anyOf", Json::array({std::move(first), std::move(second)})}};
}

std::vector<const TableInfo*> joined(std::vector<const TableInfo*> first,
                                     const std::vector<const TableInfo*>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace twincraft
