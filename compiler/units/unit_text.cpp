// The grammar of unit texts:
//   unit   = factor { [ "." | "*" | "/" | "-" | blanks ] factor }
//   factor = ( letters | "(" unit ")" ) [ [ "^" | "**" ] [ "-" ] digits ]
// A power is not 0 and has at most two digits; a unit begins with a letter or a bracket.
// Tested by tests/compiler/units_test.cpp.
#include "compiler/units/unit_text.h"

#include <algorithm>
#include <array>
#include <utility>

namespace twincraft {
namespace {

constexpr std::size_t kLongest = 64;  // bytes; also bounds the depth of brackets

constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kAsciiFor{{
    {"\u00B5", "u"},  // micro sign
    {"\u03BC", "u"},  // Greek mu
    {"\u00B0", "deg"},
    {"\u00B7", "."},
    {"\u22C5", "."},
    {"\u207B", "-"},
    {"\u00B9", "1"},
    {"\u00B2", "2"},
    {"\u00B3", "3"},
}};

std::string in_ascii(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const auto found = std::ranges::find_if(
        kAsciiFor, [text](const auto& entry) { return text.starts_with(entry.first); });
    const bool known = found != kAsciiFor.end();
    result += known ? found->second : text.substr(0, 1);
    text.remove_prefix(known ? found->first.size() : 1);
  }
  return result;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  bool read() { return unit() && at_ == text_.size(); }
  std::vector<std::string> take_names() { return std::move(names_); }

 private:
  char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }

  bool skip(std::string_view token) {
    if (!text_.substr(at_).starts_with(token)) return false;
    at_ += token.size();
    return true;
  }

  bool unit() {
    if (!factor()) return false;
    while (separator()) {
      if (!factor()) return false;
    }
    return true;
  }

  /// Blanks, a sign of multiplication or division, or both; false at the end of the unit.
  bool separator() {
    const std::size_t before = at_;
    while (skip(" ")) {
    }
    const bool sign = skip(".") || skip("*") || skip("/") || skip("-");
    while (skip(" ")) {
    }
    return sign || (at_ > before && at_ < text_.size() && peek() != ')');
  }

  bool factor() {
    if (skip("(")) return unit() && skip(")") && power();
    const std::size_t begin = at_;
    while (is_letter(peek())) ++at_;
    if (at_ == begin || text_[begin] == '_') return false;
    names_.emplace_back(text_.substr(begin, at_ - begin));
    return power();
  }

  /// True as well when there is none.
  bool power() {
    const bool sign = skip("^") || skip("**");
    const bool negative = peek() == '-' && is_digit(peek(1));
    if (!sign && !negative && !is_digit(peek())) return true;
    if (negative) ++at_;
    const std::size_t begin = at_;
    while (is_digit(peek())) ++at_;
    const std::size_t digits = at_ - begin;
    return digits >= 1 && digits <= 2 && text_[begin] != '0';
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<std::string> names_;
};

}  // namespace

std::optional<UnitText> read_unit_text(std::string_view text) {
  if (text.size() > kLongest) return std::nullopt;
  UnitText result{in_ascii(text), {}};
  Reader reader(result.ascii);
  if (!reader.read()) return std::nullopt;
  result.names = reader.take_names();
  return result;
}

}  // namespace twincraft
