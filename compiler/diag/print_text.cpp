// Diagnostics for people: the line they wrote with a caret under the fault. Whatever the text
// contains, the terminal gets printable characters only, and a caret stands under its character.
// Tested by tests/compiler/diag_test.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "compiler/diag/print.h"
#include "compiler/diag/utf8.h"

namespace twincraft {
namespace {

constexpr std::size_t kExcerptWidth = 90;  // columns of the terminal, without the line number
constexpr std::size_t kBeforeCaret = 30;   // of these, when a long line is cut

struct Style {
  bool colour;

  std::string paint(std::string_view escape, std::string_view text) const {
    return colour ? fmt::format("\x1b[{}m{}\x1b[0m", escape, text) : std::string(text);
  }
  std::string bold(std::string_view text) const { return paint("1", text); }
  std::string caret(std::string_view text) const { return paint("1;32", text); }
  std::string severity(Severity severity, std::string_view text) const {
    switch (severity) {
      case Severity::kError:
        return paint("1;31", text);
      case Severity::kWarning:
        return paint("1;35", text);
      case Severity::kNote:
        break;
    }
    return paint("1;36", text);
  }
};

/// `file:line:column: `, or nothing without a source.
std::string place_of(const Span& span) {
  if (span.source == nullptr) return {};
  return fmt::format("{}:{}:{}: ", printable(span.source->name()), span.line, span.column);
}

/// One character of the source line as it appears on the terminal.
struct Cell {
  std::string shown;
  std::size_t width;
  bool marked;
};

std::size_t width_of(std::span<const Cell> cells) {
  std::size_t width = 0;
  for (const Cell& cell : cells) width += cell.width;
  return width;
}

std::vector<Cell> cells_of(std::string_view line, std::size_t mark_begin, std::size_t mark_end) {
  std::vector<Cell> cells;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t length = std::max<std::size_t>(1, decode_utf8(line, at).length);
    const std::string_view raw = line.substr(at, length);
    std::string shown = raw == "\t" ? "    " : printable(raw);
    const std::size_t width = shown == raw ? 1 : shown.size();
    cells.push_back({std::move(shown), width, at + length > mark_begin && at < mark_end});
    at += length;
  }
  // A fault may lie just after the end of its line.
  if (mark_begin >= line.size()) cells.push_back({" ", 1, true});
  return cells;
}

/// Drops the cells far from the first marked one when the line is too wide to show.
void cut_around_mark(std::vector<Cell>& cells) {
  if (width_of(cells) <= kExcerptWidth) return;
  const auto mark = std::ranges::find(cells, true, &Cell::marked);
  std::size_t begin = static_cast<std::size_t>(mark - cells.begin());
  for (std::size_t width = 0; begin > 0 && width < kBeforeCaret; --begin) {
    width += cells[begin - 1].width;
  }
  std::size_t end = begin;
  for (std::size_t width = 0; end < cells.size() && width < kExcerptWidth; ++end) {
    width += cells[end].width;
  }
  if (end < cells.size()) {
    cells.resize(end);
    cells.push_back({"...", 3, false});
  }
  if (begin > 0) {
    cells.erase(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(begin));
    cells.insert(cells.begin(), Cell{"...", 3, false});
  }
}

/// The cells around the mark; a line may be megabytes long, of which few bytes can be shown.
std::vector<Cell> cells_near_mark(const Span& span) {
  constexpr std::size_t kNear = 512;  // bytes, more characters than are shown
  std::string_view line = span.source->line(span.line);
  std::size_t begin = static_cast<std::size_t>(std::max(span.column, 1) - 1);
  line = line.substr(0, begin + kNear);
  if (begin > kNear && line.size() > kNear) {
    const std::size_t dropped = std::min(begin, line.size()) - kNear;
    line.remove_prefix(dropped);
    begin -= dropped;
  }
  return cells_of(line, begin, begin + static_cast<std::size_t>(std::max(span.length, 1)));
}

/// The source line and the line with the caret below it.
std::string excerpt(const Span& span, const Style& style) {
  std::vector<Cell> cells = cells_near_mark(span);
  cut_around_mark(cells);
  std::string text;
  for (const Cell& cell : cells) text += cell.shown;
  text.erase(text.find_last_not_of(' ') + 1);
  const auto is_marked = [](const Cell& cell) { return cell.marked; };
  const auto first = std::ranges::find_if(cells, is_marked);
  const auto past = std::find_if_not(first, cells.end(), is_marked);
  const std::string pad(width_of({cells.begin(), first}), ' ');
  std::string mark(width_of({first, past}), '~');
  mark.front() = '^';
  return fmt::format("{:>5} | {}\n      | {}{}\n", span.line, text, pad, style.caret(mark));
}

std::string block(const Diagnostic& diagnostic, const Style& style) {
  const std::string kind =
      fmt::format("{}[{}]", severity_name(diagnostic.severity), code_name(diagnostic.code));
  std::string text = fmt::format("{}{}: {}\n", style.bold(place_of(diagnostic.span)),
                                 style.severity(diagnostic.severity, kind),
                                 style.bold(printable(diagnostic.message)));
  if (diagnostic.span.source != nullptr) text += excerpt(diagnostic.span, style);
  if (!diagnostic.hint.empty()) text += fmt::format("  hint: {}\n", printable(diagnostic.hint));
  for (const Note& note : diagnostic.notes) {
    text += fmt::format("  note: {}{}\n", place_of(note.span), printable(note.message));
  }
  return text;
}

std::string counted(std::size_t count, std::string_view word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

/// `2 errors, 1 warning`; kinds that do not occur are left out.
std::string summary(const std::vector<Diagnostic>& diagnostics, std::size_t dropped) {
  std::string text;
  for (const Severity severity : {Severity::kError, Severity::kWarning, Severity::kNote}) {
    auto count =
        static_cast<std::size_t>(std::ranges::count(diagnostics, severity, &Diagnostic::severity));
    if (severity == Severity::kError) count += dropped;
    if (count == 0) continue;
    text += text.empty() ? "" : ", ";
    text += counted(count, severity_name(severity));
  }
  return text + "\n";
}

}  // namespace

std::string to_text(const Diagnostics& diagnostics, const PrintOptions& options) {
  const std::vector<Diagnostic> sorted = diagnostics.sorted();
  if (sorted.empty()) return {};
  const Style style{options.colour};
  std::string text;
  std::size_t errors = 0;
  for (const Diagnostic& diagnostic : sorted) {
    const bool is_error = diagnostic.severity == Severity::kError;
    if (is_error && ++errors > options.max_errors) continue;
    text += block(diagnostic, style);
  }
  errors += diagnostics.dropped();
  if (errors > options.max_errors) {
    text += counted(errors - options.max_errors, "further error") + " not shown\n";
  }
  return text + summary(sorted, diagnostics.dropped());
}

}  // namespace twincraft
