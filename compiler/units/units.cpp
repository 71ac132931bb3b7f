// Numbers with units. The number is read by an own grammar, strictly decimal and immune to locales;
// of a decimal multiple of SI the exponent is shifted before the one rounding to a double.
// Tested by tests/compiler/units_test.cpp.
#include "compiler/units/units.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "compiler/diag/diagnostics.h"
#include "compiler/units/unit_system.h"

namespace twincraft {
namespace {

constexpr std::string_view kOutOfRange = "is outside the range of numbers, about 1e-308 to 1e308";

Quantity failure(std::string error, std::string hint = {}) {
  return {0.0, std::move(error), std::move(hint), {}, 1.0};
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

/// A text that begins with a decimal number.
struct NumberText {
  std::string_view mantissa;  // "-12.5", without a leading `+`
  std::string_view exponent;  // "3" of "1e+3", may be empty
  std::string_view rest;      // what follows, with its blanks
};

std::size_t count_digits(std::string_view text) {
  std::size_t count = 0;
  while (count < text.size() && is_digit(text[count])) ++count;
  return count;
}

std::optional<NumberText> split_number(std::string_view text) {
  if (text.starts_with("+-")) return std::nullopt;
  if (text.starts_with('+')) text.remove_prefix(1);
  std::size_t end = text.starts_with('-') ? 1 : 0;
  const std::size_t whole = count_digits(text.substr(end));
  end += whole;
  std::size_t fraction = 0;
  if (text.substr(end).starts_with('.')) {
    fraction = count_digits(text.substr(end + 1));
    end += 1 + fraction;
  }
  if (whole + fraction == 0) return std::nullopt;
  NumberText number{text.substr(0, end), {}, text.substr(end)};
  if (!number.rest.starts_with('e') && !number.rest.starts_with('E')) return number;
  std::string_view exponent = number.rest.substr(1);
  if (exponent.starts_with('+')) exponent.remove_prefix(1);
  const std::size_t sign = exponent.starts_with('-') ? 1 : 0;
  const std::size_t digits = count_digits(exponent.substr(sign));
  if (digits == 0) return number;  // "5 eV" has none
  number.exponent = exponent.substr(0, sign + digits);
  number.rest = exponent.substr(sign + digits);
  return number;
}

bool has_leading_zero(std::string_view mantissa) {
  if (mantissa.starts_with('-')) mantissa.remove_prefix(1);
  return mantissa.size() > 1 && mantissa[0] == '0' && is_digit(mantissa[1]);
}

/// The nearest double of the number times a power of ten; none when a double cannot hold it.
std::optional<double> nearest_double(const NumberText& number, int shift) {
  if (number.mantissa.find_first_of("123456789") == std::string_view::npos) return 0.0;
  int exponent = 0;
  if (!number.exponent.empty()) {
    const std::string_view digits = number.exponent;
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (result.ec != std::errc() || std::abs(exponent) > 1'000'000) return std::nullopt;
  }
  const std::string text = fmt::format("{}e{}", number.mantissa, exponent + shift);
  double value = 0.0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  // A subnormal has lost digits that were written.
  if (result.ec != std::errc() || !std::isnormal(value)) return std::nullopt;
  return value;
}

/// The exponent when `factor` is the double of a power of ten.
std::optional<int> power_of_ten(double factor) {
  const int exponent = static_cast<int>(std::lround(std::log10(factor)));
  const std::optional<double> power = nearest_double({"1", {}, {}}, exponent);
  return power == factor ? std::optional(exponent) : std::nullopt;
}

std::optional<double> converted(const NumberText& number, double factor) {
  if (const std::optional<int> shift = power_of_ten(factor)) return nearest_double(number, *shift);
  const std::optional<double> plain = nearest_double(number, 0);
  if (!plain || *plain == 0.0) return plain;
  const double value = *plain * factor;
  return std::isnormal(value) ? std::optional(value) : std::nullopt;
}

/// Words of YAML and of other languages for numbers that are none.
bool is_not_finite(std::string_view text) {
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  if (text.starts_with('.')) text.remove_prefix(1);
  std::string word(text.substr(0, text.find(' ')));
  for (char& c : word) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return word == "nan" || word == "inf" || word == "infinity";
}

/// Why a text that does not begin with a number is no number.
Quantity explain_no_number(std::string_view text) {
  if (text.empty()) return failure("an empty text is not a number");
  if (is_not_finite(text)) return failure(fmt::format("{} is not finite", in_backticks(text)));
  const bool is_unit = find_unit(text).error.empty();
  if (is_unit) {
    return failure(fmt::format("{} is a unit without its number", in_backticks(text)),
                   fmt::format("write the number before it, such as `1 {}`", text));
  }
  const bool has_pi = text.find("pi") != std::string_view::npos;
  return failure(fmt::format("{} is not a number", in_backticks(text)),
                 has_pi ? "there are no formulas: write the digits, or an angle as `90 deg`" : "");
}

/// `0x10`, `0b101`, `0o17`
bool is_other_base(const NumberText& number) {
  if (number.mantissa != "0" || number.rest.size() < 2) return false;
  const char letter = number.rest[0];
  const bool hexadecimal = letter == 'x' || letter == 'X';
  return (hexadecimal && std::isxdigit(static_cast<unsigned char>(number.rest[1])) != 0) ||
         ((letter == 'o' || letter == 'b') && is_digit(number.rest[1]));
}

/// `1e`, `2.5e-`, `1e kg`: of an exponent that has no digits; not `5 e`, which is a unit.
bool is_incomplete(const NumberText& number) {
  std::string_view rest = number.rest;
  if (!number.exponent.empty() || rest.empty() || (rest[0] != 'e' && rest[0] != 'E')) return false;
  rest.remove_prefix(1);
  if (rest.starts_with('+') || rest.starts_with('-')) rest.remove_prefix(1);
  return rest.empty() || rest[0] == ' ' || rest[0] == '\t';
}

/// `1.5d3`, which is also 1.5 days cubed: the exponent of Fortran.
bool is_fortran(std::string_view rest) {
  if (rest.empty() || (rest[0] != 'd' && rest[0] != 'D')) return false;
  rest.remove_prefix(1);
  if (rest.starts_with('+') || rest.starts_with('-')) rest.remove_prefix(1);
  const std::size_t digits = count_digits(rest);
  return digits > 0 && (digits == rest.size() || rest[digits] == ' ');
}

/// What to write instead when a number goes on with `next`; none when a unit may begin there.
std::optional<std::string_view> hint_for(char next) {
  switch (next) {
    case '_':
      return "write digits without `_`";
    case ',':
      return "the decimal sign is a point; a list has brackets: `[1, 2]`";
    case ':':
      return "write times and angles with a unit: `90 min`, `12.5 deg`";
    case '%':
      return "write a fraction: `0.05` for 5 %";
    case '.':
    case '+':
    case '-':
    case '*':
    case '/':
      return "write one number, and its unit after a blank";
    default:
      return std::nullopt;
  }
}

/// Why the text is no number although it begins with one; none when its rest may be a unit.
std::optional<Quantity> explain_bad_number(std::string_view text, const NumberText& number) {
  const std::string shown = in_backticks(text);
  if (has_leading_zero(number.mantissa)) {
    return failure(fmt::format("{} has a leading zero", shown),
                   "numbers are decimal; write it without the zero");
  }
  if (is_incomplete(number))
    return failure(fmt::format("{} is an incomplete number: nothing follows the `e`", shown),
                   "write the exponent, such as `1e3`, or leave the `e` out");
  if (is_fortran(number.rest))
    return failure(fmt::format("{} is not a number: the exponent begins with `e`", shown),
                   "write for example `1.5e3`");
  if (is_other_base(number)) return failure(fmt::format("{} is not a decimal number", shown));
  const std::string_view rest = trimmed(number.rest);
  if (rest.empty()) return std::nullopt;
  if (is_digit(rest[0])) {
    return failure(fmt::format("{} is two numbers", shown), "a list has brackets: `[1, 2]`");
  }
  const std::optional<std::string_view> hint = hint_for(rest[0]);
  if (!hint) return std::nullopt;
  return failure(fmt::format("{} is not a number", shown), std::string(*hint));
}

/// The unit of a field, which is ours and hence right.
Unit si_unit(SiUnit si) {
  if (si == "1") return {};
  Unit unit = find_unit(si);
  if (!unit.error.empty()) throw std::logic_error(fmt::format("field unit: {}", unit.error));
  return unit;
}

Quantity wrong_dimension(std::string_view text, const Dimension& given, SiUnit si) {
  const Dimension expected = si_unit(si).dimension;
  const std::string wanted =
      si == "1" ? describe(expected) : fmt::format("{} [{}]", describe(expected), si);
  Quantity result =
      failure(fmt::format("{} is {}, {} is expected", in_backticks(text), describe(given), wanted));
  Dimension turned = given;
  turned["rad"] += 1;
  if (turned == expected) result.hint = "count in angles: `rad/s`, `deg/s`, `rpm` or `rev/s`";
  return result;
}

/// The factor of `unit` to `si`; faults name `text`, in which the unit was written.
Quantity factor_between(std::string_view text, std::string_view unit_text, SiUnit si) {
  const Unit expected = si_unit(si);
  const Unit unit = find_unit(unit_text);
  if (!unit.error.empty()) return failure(unit.error, unit.hint);
  if (!fits(unit.dimension, expected.dimension)) return wrong_dimension(text, unit.dimension, si);
  return {unit.factor / expected.factor, {}, {}, {}, 1.0};
}

}  // namespace

Quantity parse_quantity(std::string_view text, SiUnit si) {
  text = trimmed(text);
  const std::optional<NumberText> number = split_number(text);
  if (!number) return explain_no_number(text);
  if (const auto fault = explain_bad_number(text, *number)) return *fault;
  Quantity quantity;
  quantity.unit = trimmed(number->rest);
  if (!quantity.unit.empty()) {
    Quantity found = factor_between(text, quantity.unit, si);
    if (!found.error.empty()) return found;
    quantity.factor = found.value;
  }
  const std::optional<double> value = converted(*number, quantity.factor);
  if (!value) return failure(fmt::format("{} {}", in_backticks(text), kOutOfRange));
  quantity.value = *value;
  return quantity;
}

Quantity parse_number(std::string_view text) {
  text = trimmed(text);
  const std::optional<NumberText> number = split_number(text);
  if (number && !explain_bad_number(text, *number) && !trimmed(number->rest).empty()) {
    return failure(fmt::format("{} has a unit, a plain number is expected", in_backticks(text)));
  }
  return parse_quantity(text, "1");
}

Quantity unit_factor(std::string_view unit, SiUnit si) {
  unit = trimmed(unit);
  if (unit.empty()) return failure("an empty text is not a unit");
  return factor_between(unit, unit, si);
}

}  // namespace twincraft
