// Reading a value from text in tests, with its faults as lines that can be compared.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "compiler/schema/table.h"
#include "compiler/syntax/load.h"

namespace twincraft {

/// `line:column SC2005 message`, then ` (hint)`, then ` | line:column note`.
inline std::vector<std::string> lines_of(const Diagnostics& diagnostics) {
  std::vector<std::string> lines;
  for (const Diagnostic& fault : diagnostics.all()) {
    std::string line = fmt::format("{}:{} {} {}", fault.span.line, fault.span.column,
                                   code_name(fault.code), fault.message);
    if (!fault.hint.empty()) line += fmt::format(" ({})", fault.hint);
    for (const Note& note : fault.notes)
      line += fmt::format(" | {}:{} {}", note.span.line, note.span.column, note.message);
    lines.push_back(line);
  }
  return lines;
}

/// A text as a syntax tree; the struct read from it points into the tree.
struct Text {
  explicit Text(std::string text) {
    Diagnostics diagnostics;
    std::optional<Node> parsed =
        parse_value(sources.add("test.yaml", std::move(text)), diagnostics);
    if (!parsed) throw std::logic_error("not YAML: " + lines_of(diagnostics).front());
    root = std::move(*parsed);
  }
  Text(const Text&) = delete;
  Text& operator=(const Text&) = delete;

  Sources sources;
  Node root;
};

template <class V>
struct Reading {
  std::optional<V> value;
  std::vector<std::string> faults;
};

/// Read `text` as the value of something called `it`.
template <class V>
Reading<V> read(const Kind<V>& kind, const std::string& text) {
  const Text source(text);
  Diagnostics diagnostics;
  ReadContext context{diagnostics, "`it`"};
  std::optional<V> value = kind.read(source.root, context);
  return {std::move(value), lines_of(diagnostics)};
}

}  // namespace twincraft
