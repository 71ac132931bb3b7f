// See manual.h. Tested by tests/compiler/schema_test.cpp.
#include "compiler/schema/manual.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/ir/number.h"
#include "compiler/schema/table_info.h"

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

/// What the column `kind` of the tables means.
constexpr std::string_view kValues =
    R"(## values

What the kinds of the tables below are, and how they are written.

**Quantity.** A plain number is in the SI unit in brackets: `mass: 600` is 600 kg, `angle: 0.1` is 0.1 rad. A text is a
number and a unit of the same dimension: `0.6 t`, `12 deg`, `6000 rpm`, `20 mN m`. Plain numbers that look like another
unit get a warning (`angle: 45`).

**Vector, list of quantities.** Every entry is a quantity of its own: `[10 mm, 5 mm, 0]`. One unit for all entries is
written `{value: [10, 5, 0], unit: mm}`; the entries are plain numbers then.

**Inertia.** `[Ixx, Iyy, Izz]`, or the symmetric tensor as three rows. Entries off the diagonal are entries of the
tensor, which are minus the products of inertia: Ixy = -integral of x y dm. One unit for all entries is written
`{value: [..], unit: g cm2}`.

**Direction.** Three plain numbers `[x, y, z]` of any length but zero.

**Schedule.** Either one quantity, which holds all the time, or a list of points `[time, value]` with increasing times:

```yaml
torque: [[0 s, 0.01 N m], [40 s, -0.01 N m], [80 s, 0]]
```

Each value holds from its time until the next point; the last one holds to the end of the run. Before the first point
the value is 0. The value is constant between points, never interpolated, and every integrator steps exactly onto the
times. Of a force or torque with three components each component is a quantity or a schedule:
`force: [0, 0, [[0 s, 1 N], [5 s, 0]]]`.

**Intervals.** A list of `[start, end]`, each with start before end, one after another. An interval holds from its start
until just before its end: `during: [[0 s, 900 s], [2000 s, 2100 s]]`.

**Name.** A letter, then letters, digits, `_` and `-`. Names are unique in the whole file.

)";

}  // namespace

std::string reference_text(const TableInfo& root) {
  std::vector<const TableInfo*> tables;
  collect(root, tables);
  std::string text;
  for (const TableInfo* table : tables) {
    if (!text.empty()) text += '\n';
    text += section_of(*table);
    if (table == &root) text += fmt::format("\n{}", kValues.substr(0, kValues.size() - 1));
  }
  return text;
}

}  // namespace twincraft
