// See reference.h. Tested by tests/compiler/schema_test.cpp.
#include "compiler/schema/reference.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/ir/number.h"

namespace twincraft {
namespace {

/// A value as one would write it in a spec.
std::string as_written(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return shortest(value.get<double>());
  if (!value.is_structured()) return value.dump();
  std::string items;
  for (const auto& [key, item] : value.items()) {
    if (!items.empty()) items += ", ";
    items += value.is_object() ? key + ": " + as_written(item) : as_written(item);
  }
  return value.is_object() ? fmt::format("{{{}}}", items) : fmt::format("[{}]", items);
}

/// Text for a cell: a bar would end it.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

std::string default_cell(const FieldInfo& field) {
  if (field.required) return "required";
  if (!field.default_value) return {};
  return fmt::format("`{}`", cell(as_written(*field.default_value)));
}

std::string section_of(const TableInfo& table) {
  std::string text = fmt::format("## {}\n\n{}\n\n", table.name, table.doc);
  text += "| key | kind | default | meaning |\n|---|---|---|---|\n";
  for (const FieldInfo& field : table.fields)
    text += fmt::format("| `{}` | {} | {} | {} |\n", field.key, cell(field.kind),
                        default_cell(field), cell(field.doc));
  for (const KeyGroup& group : table.groups)
    text += fmt::format("\n{} of {} is written.\n", group.required ? "Exactly one" : "At most one",
                        words_text(group.keys, "and"));
  return text;
}

/// `table` and those below it in the order in which a reader meets them, each once.
void collect(const TableInfo& table, std::vector<const TableInfo*>& tables) {
  if (std::find(tables.begin(), tables.end(), &table) != tables.end()) return;
  tables.push_back(&table);
  for (const FieldInfo& field : table.fields)
    for (const TableInfo* nested : field.tables) collect(*nested, tables);
}

}  // namespace

std::string reference_text(const TableInfo& root) {
  std::vector<const TableInfo*> tables;
  collect(root, tables);
  std::string text;
  for (const TableInfo* table : tables) {
    if (!text.empty()) text += "\n";
    text += section_of(*table);
  }
  return text;
}

}  // namespace twincraft
