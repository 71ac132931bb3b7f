// The gate in front of yaml-cpp, which stops silently at NUL, takes invalid UTF-8 as it comes and
// may hold a token of about 200 bytes for every bracket of a line. Tested by
// tests/compiler/load_test.cpp.
#include "compiler/syntax/text_check.h"

#include <fmt/format.h>

#include "compiler/diag/utf8.h"
#include "compiler/syntax/load.h"

namespace twincraft {
namespace {

// Quotes and comments are not told apart here, so brackets in prose count too; ten thousand more
// opened than closed is no prose.
constexpr std::size_t kOpenBracketsInAnyText = 10'000;

/// The encoding whose mark a text begins with, or whose zeros are about its first character.
std::string_view wide_encoding(std::string_view text) {
  using namespace std::string_view_literals;
  const std::string_view first = text.substr(0, 4);
  if (first == "\xFF\xFE\0\0"sv || first == "\0\0\xFE\xFF"sv) return "UTF-32";
  if (first.starts_with("\xFF\xFE") || first.starts_with("\xFE\xFF")) return "UTF-16";
  std::string zeros;
  for (const char c : first) zeros += c == '\0' ? '0' : 'x';
  if (zeros == "x000" || zeros == "000x") return "UTF-32";
  if (zeros == "x0x0" || zeros == "0x0x") return "UTF-16";
  return {};
}

bool is_forbidden(char32_t code, std::string_view rest) {
  if (code == '\n' || code == '\t') return false;
  if (code == '\r') return !rest.starts_with("\r\n");
  // U+0085, a line end of mainframes, is harmless inside text.
  return is_control(code) && code != 0x85;
}

void report_control(const Source& source, std::size_t at, char32_t code, Diagnostics& diagnostics) {
  Diagnostic& fault = diagnostics.error(
      Code::kControlCharacter, source.span(at, 1),
      fmt::format("control character U+{:04X} in the text", static_cast<unsigned>(code)));
  if (code == '\r') {
    fault.with_hint("end lines with a line feed, or carriage return and line feed");
  } else {
    fault.with_hint("delete the character");
  }
}

bool check_characters(const Source& source, Diagnostics& diagnostics) {
  const std::string_view text = source.text();
  if (const std::string_view encoding = wide_encoding(text); !encoding.empty()) {
    diagnostics
        .error(Code::kNotUtf8, source.span(0, 1),
               fmt::format("the text is {}, not UTF-8", encoding))
        .with_hint("save the file as UTF-8");
    return false;
  }
  for (std::size_t at = 0; at < text.size();) {
    const Utf8Character character = decode_utf8(text, at);
    if (character.length == 0) {
      diagnostics
          .error(Code::kNotUtf8, source.span(at, 1),
                 fmt::format("byte 0x{:02X} is not UTF-8", static_cast<unsigned char>(text[at])))
          .with_hint("save the file as UTF-8");
      return false;
    }
    if (is_forbidden(character.code, text.substr(at, 2))) {
      report_control(source, at, character.code, diagnostics);
      return false;
    }
    at += character.length;
  }
  return true;
}

/// Every YAML token but a plain scalar has one of these characters, so their number bounds the
/// memory and time of the parser.
bool is_indicator(char c) {
  return std::string_view("[]{},:?&*!|>'\"%").find(c) != std::string_view::npos;
}

bool check_structure(const Source& source, Diagnostics& diagnostics) {
  const std::string_view text = source.text();
  std::size_t indicators = 0;
  std::size_t open = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (!is_indicator(c)) continue;
    if (++indicators > kMaximumIndicators) {
      diagnostics.error(Code::kTooLarge, source.span(at, 1),
                        fmt::format("more than {} punctuation characters", kMaximumIndicators));
      return false;
    }
    if (c == '[' || c == '{') ++open;
    if ((c == ']' || c == '}') && open > 0) --open;
    if (open > kOpenBracketsInAnyText) {
      diagnostics.error(Code::kTooDeep, source.span(at, 1),
                        fmt::format("more than {} brackets are open here", kOpenBracketsInAnyText));
      return false;
    }
  }
  return true;
}

}  // namespace

bool check_text(const Source& source, Diagnostics& diagnostics) {
  if (source.text().size() > kMaximumFileBytes) {
    diagnostics.error(Code::kTooLarge, {},
                      fmt::format("{} is larger than {} MiB", in_backticks(source.name()),
                                  kMaximumFileBytes >> 20));
    return false;
  }
  return check_characters(source, diagnostics) && check_structure(source, diagnostics);
}

}  // namespace twincraft
