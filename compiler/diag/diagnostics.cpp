// The collector of faults and the helpers that word them. Tested by tests/compiler/diag_test.cpp.
#include "compiler/diag/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "compiler/diag/utf8.h"

namespace twincraft {
namespace {

struct CodeEntry {
  Code code;
  std::string_view name;
  std::string_view title;
  std::string_view explanation;
};

constexpr std::array kRegistry{
#define TWINCRAFT_CODE(identifier, number, title, explanation) \
  CodeEntry{Code::identifier, "SC" #number, title, explanation},
#include "compiler/diag/codes.def"
#undef TWINCRAFT_CODE
};

const CodeEntry& entry_of(Code code) { return kRegistry.at(static_cast<std::size_t>(code)); }

constexpr std::size_t kKept = 10'000;

/// Unicode's means to reorder or hide text, which would let a message show other text than it has.
bool misleads_reader(char32_t code) {
  return (code >= 0x200B && code <= 0x200F) || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2060 && code <= 0x206F) || code == 0xFEFF;
}

std::string escaped(char32_t code) {
  switch (code) {
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    default:
      break;
  }
  const auto number = static_cast<unsigned>(code);
  return code < 0x80 ? fmt::format("\\x{:02x}", number) : fmt::format("\\u{:04x}", number);
}

}  // namespace

std::string_view severity_name(Severity severity) {
  switch (severity) {
    case Severity::kError:
      return "error";
    case Severity::kWarning:
      return "warning";
    case Severity::kNote:
      break;
  }
  return "note";
}

std::string_view code_name(Code code) { return entry_of(code).name; }
std::string_view code_title(Code code) { return entry_of(code).title; }
std::string_view code_explanation(Code code) { return entry_of(code).explanation; }

const std::vector<Code>& all_codes() {
  static const std::vector<Code> codes = [] {
    std::vector<Code> result;
    for (const CodeEntry& entry : kRegistry) result.push_back(entry.code);
    return result;
  }();
  return codes;
}

Diagnostic& Diagnostics::add(Diagnostic diagnostic) {
  if (diagnostic.severity == Severity::kError && all_.size() >= kKept) {
    ++dropped_;
    return last_dropped_ = std::move(diagnostic);
  }
  return all_.emplace_back(std::move(diagnostic));
}

void Diagnostics::take(Diagnostic diagnostic) { add(std::move(diagnostic)); }

Diagnostic& Diagnostics::error(Code code, Span span, std::string message) {
  return add({Severity::kError, code, span, std::move(message), {}, {}});
}

Diagnostic& Diagnostics::warning(Code code, Span span, std::string message) {
  return add({Severity::kWarning, code, span, std::move(message), {}, {}});
}

Diagnostic& Diagnostics::note(Code code, Span span, std::string message) {
  return add({Severity::kNote, code, span, std::move(message), {}, {}});
}

void Diagnostics::keep(std::shared_ptr<const Sources> texts) { texts_.insert(std::move(texts)); }

void Diagnostics::silence(const std::vector<Code>& codes) {
  std::erase_if(all_, [&codes](const Diagnostic& fault) {
    return fault.severity != Severity::kError && std::ranges::count(codes, fault.code) > 0;
  });
}

void Diagnostics::promote_warnings() {
  for (Diagnostic& fault : all_)
    if (fault.severity == Severity::kWarning) fault.severity = Severity::kError;
}

std::size_t Diagnostics::error_count() const {
  return dropped_ + static_cast<std::size_t>(
                        std::ranges::count(all_, Severity::kError, &Diagnostic::severity));
}

std::vector<Diagnostic> Diagnostics::sorted() const {
  std::map<const Source*, std::size_t> mention;
  for (const Diagnostic& diagnostic : all_) {
    mention.emplace(diagnostic.span.source, mention.size());
  }
  std::vector<Diagnostic> result = all_;
  const auto place = [&mention](const Diagnostic& diagnostic) {
    const Span& span = diagnostic.span;
    return std::tuple(mention.at(span.source), span.line, span.column);
  };
  std::ranges::stable_sort(result, {}, place);
  // Repeats share their place, but another fault of that place may stand between them.
  std::vector<Diagnostic> unique;
  for (Diagnostic& diagnostic : result) {
    const auto same_place =
        std::ranges::find_if(unique.rbegin(), unique.rend(),
                             [&](const Diagnostic& d) { return place(d) != place(diagnostic); });
    if (std::find(unique.rbegin(), same_place, diagnostic) == same_place) {
      unique.push_back(std::move(diagnostic));
    }
  }
  return unique;
}

std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const Utf8Character character = decode_utf8(text, at);
    if (character.length == 0) {
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[at]));
      ++at;
      continue;
    }
    if (is_control(character.code) || misleads_reader(character.code)) {
      result += escaped(character.code);
    } else {
      result += text.substr(at, character.length);
    }
    at += character.length;
  }
  return result;
}

std::string in_backticks(std::string_view text) {
  constexpr std::size_t kLongest = 60;  // bytes; about half a line of a terminal
  if (text.size() <= kLongest) return fmt::format("`{}`", printable(text));
  std::size_t end = 0;
  while (end < kLongest) end += std::max<std::size_t>(1, decode_utf8(text, end).length);
  return fmt::format("`{}...`", printable(text.substr(0, end)));
}

}  // namespace twincraft
