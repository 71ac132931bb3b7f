// Looks at the text around a mark. Tested by tests/compiler/load_test.cpp.
#include "compiler/syntax/scan.h"

#include <algorithm>

namespace twincraft {
namespace {

constexpr std::string_view kWhiteSpace = " \t\r\n";

std::size_t or_end(std::string_view text, std::size_t found) {
  return std::min(found, text.size());
}

}  // namespace

char char_at(std::string_view text, std::size_t at) { return at < text.size() ? text[at] : '\0'; }

std::size_t skip_blanks(std::string_view text, std::size_t at) {
  return or_end(text, text.find_first_not_of(" \t", at));
}

std::size_t end_of_word(std::string_view text, std::size_t at) {
  return or_end(text, text.find_first_of(" \t\r\n[]{},", at));
}

std::size_t last_visible(std::string_view text, std::size_t at) {
  const std::size_t found = text.substr(0, at).find_last_not_of(kWhiteSpace);
  return found == std::string_view::npos ? at : found;
}

std::size_t length_on_line(std::string_view text, std::size_t begin, std::size_t end) {
  const std::string_view token = text.substr(begin, end - begin);
  return std::max<std::size_t>(1, or_end(token, token.find_first_of("\r\n")));
}

std::optional<std::size_t> find_closing_quote(std::string_view text, std::size_t open) {
  const char quote = text[open];
  for (std::size_t at = open + 1; at < text.size(); ++at) {
    if (quote == '"' && text[at] == '\\') {
      ++at;
    } else if (text[at] == quote) {
      if (quote == '"' || char_at(text, at + 1) != quote) return at;
      ++at;  // two single quotes stand for one
    }
  }
  return std::nullopt;
}

std::size_t end_of_plain(std::string_view text, std::size_t at, std::string_view value) {
  const char first = char_at(text, at);
  if (first == '|' || first == '>') at = or_end(text, text.find('\n', at));
  for (const char c : value) {
    if (kWhiteSpace.find(c) != std::string_view::npos) continue;
    at = or_end(text, text.find_first_not_of(kWhiteSpace, at));
    if (char_at(text, at) != c) break;
    ++at;
  }
  return at;
}

std::size_t length_of_null(std::string_view text, std::size_t at) {
  const std::string_view word = text.substr(at, end_of_word(text, at) - at);
  const bool is_null = word == "~" || word == "null" || word == "Null" || word == "NULL";
  return is_null ? word.size() : 0;
}

bool begins_document(std::string_view text, std::size_t at) {
  if (text.substr(at).starts_with("---")) return true;
  const std::size_t before = text.substr(0, at).find_last_not_of(kWhiteSpace);
  return before != std::string_view::npos && text.substr(0, before + 1).ends_with("\n...");
}

std::optional<std::size_t> find_directive(std::string_view text, std::size_t begin,
                                          std::size_t end) {
  for (std::size_t line = begin; line < end; line = or_end(text, text.find('\n', line)) + 1) {
    if (text[line] == '%') return line;
  }
  return std::nullopt;
}

}  // namespace twincraft
