// See terminal.h. Tested by tests/compiler/diag_test.cpp.
#include "compiler/diag/terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "compiler/diag/diagnostics.h"
#include "compiler/diag/utf8.h"

namespace twincraft {
namespace {

/// Length of the sequence that sets a colour at the beginning of `text`; 0: there is none.
std::size_t colour_length(std::string_view text) {
  constexpr std::size_t kLongest = 24;  // `ESC [ 38;2;255;255;255 m`, with room
  if (!text.starts_with("\x1b[")) return 0;
  const std::size_t end = text.find_first_not_of("0123456789;", 2);
  return end < kLongest && text[end] == 'm' ? end + 1 : 0;
}

/// How many bytes of ASCII that only show, line feeds and tabs `text` begins with.
std::size_t plain_length(std::string_view text) {
  const auto is_plain = [](char c) { return (c >= ' ' && c <= '~') || c == '\n' || c == '\t'; };
  return static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_plain) -
                                  text.begin());
}

/// One character, or one byte that belongs to none.
std::string_view next_character(std::string_view text) {
  const std::size_t length = decode_utf8(text, 0).length;
  return text.substr(0, length == 0 ? 1 : length);
}

}  // namespace

bool wants_colour(int file_descriptor) {
  const char* no_colour = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  return ::isatty(file_descriptor) != 0 && (no_colour == nullptr || *no_colour == '\0') &&
         terminal != nullptr && std::string_view(terminal) != "dumb";
}

std::string for_terminal(std::string_view text, bool colour) {
  std::string safe;
  safe.reserve(text.size());
  while (!text.empty()) {
    const std::size_t plain = plain_length(text);
    const std::size_t coloured = colour ? colour_length(text.substr(plain)) : 0;
    safe += text.substr(0, plain + coloured);
    text.remove_prefix(plain + coloured);
    if (coloured > 0 || text.empty()) continue;
    const std::string_view character = next_character(text);
    safe += printable(character);
    text.remove_prefix(character.size());
  }
  return safe;
}

std::string json_for_terminal(std::string_view document) {
  std::string safe;
  safe.reserve(document.size());
  while (!document.empty()) {
    const std::size_t plain = plain_length(document);
    safe += document.substr(0, plain);
    document.remove_prefix(plain);
    if (document.empty()) break;
    const std::string_view character = next_character(document);
    if (printable(character) == character)
      safe += character;
    else
      safe += fmt::format("\\u{:04x}", static_cast<unsigned>(decode_utf8(document, 0).code));
    document.remove_prefix(character.size());
  }
  return safe;
}

}  // namespace twincraft
