// The kinds of single plain values: numbers, counts, truth values, texts and names.
// Tested by tests/compiler/kind_test.cpp.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "compiler/schema/own_kind.h"

namespace twincraft {
namespace {

constexpr std::size_t kLongestName = 64;
constexpr std::string_view kNamePattern = "^[A-Za-z][A-Za-z0-9_-]*$";
constexpr std::array<std::string_view, 3> kReservedWords{"hub", "world", "com"};
constexpr std::string_view kNameRule = "a name is a letter, then letters, digits, `_` and `-`";

constexpr std::string_view kBodyName = "a body name";
constexpr std::string_view kSegmentRule =
    "segments of panels carry nothing: make the chain of `bodies` and mount it on one of them";

// Not std::isalpha and its kin: those follow the locale.
bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

bool is_name_character(char c) {
  return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

bool has_name_form(const std::string& text) {
  return !text.empty() && is_letter(text.front()) &&
         std::all_of(text.begin(), text.end(), is_name_character);
}

/// `wing.3`, as coordinates and columns call the segments of panels.
bool is_segment(const std::string& text) {
  const std::size_t dot = text.find('.');
  if (dot == std::string::npos || dot + 1 == text.size()) return false;
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return has_name_form(text.substr(0, dot)) &&
         std::all_of(text.begin() + static_cast<std::ptrdiff_t>(dot) + 1, text.end(), is_digit);
}

bool is_reserved(const std::string& text) {
  return std::find(kReservedWords.begin(), kReservedWords.end(), text) != kReservedWords.end();
}

/// A scalar with the form of a name; `expected` says whose name it is.
std::optional<std::string> read_name_form(const Node& node, ReadContext& context,
                                          const std::string& expected) {
  const std::string* text = scalar_text(node, context, expected, std::string(kNameRule));
  if (text == nullptr) return std::nullopt;
  if (text->size() > kLongestName) {
    context.diagnostics.error(Code::kBadName, node.span,
                              fmt::format("{} is {} characters long, but may have {}",
                                          context.where, text->size(), kLongestName));
    return std::nullopt;
  }
  if (!has_name_form(*text)) {
    context.diagnostics
        .error(Code::kBadName, node.span,
               text->empty()
                   ? context.where + " is empty"
                   : fmt::format("{} is {}, not {}", context.where, describe(node), expected))
        .with_hint(expected == kBodyName && is_segment(*text) ? std::string(kSegmentRule)
                                                              : std::string(kNameRule));
    return std::nullopt;
  }
  return *text;
}

std::optional<std::string> read_name(const Node& node, ReadContext& context) {
  std::optional<std::string> text = read_name_form(node, context, "a name");
  if (!text || !is_reserved(*text)) return text;
  context.diagnostics
      .error(Code::kBadName, node.span,
             fmt::format("{} is `{}`, a reserved word", context.where, *text))
      .with_hint("`hub`, `world` and `com` already have a meaning");
  return std::nullopt;
}

std::string integer_text(int minimum, int maximum) {
  if (maximum == std::numeric_limits<int>::max()) return fmt::format("whole number >= {}", minimum);
  return fmt::format("whole number from {} to {}", minimum, maximum);
}

std::optional<int> read_integer(const Node& node, ReadContext& context, int minimum, int maximum) {
  const std::optional<double> value = read_number(node, context);
  if (!value) return std::nullopt;
  if (*value != std::floor(*value)) {
    report_wrong_type(node, context, "a whole number", "");
    return std::nullopt;
  }
  if (*value >= minimum && *value <= maximum) return static_cast<int>(*value);
  context.diagnostics.error(Code::kOutOfRange, node.span,
                            fmt::format("{} is {}, but must be a {}", context.where, describe(node),
                                        integer_text(minimum, maximum)));
  return std::nullopt;
}

std::string boolean_hint(const Node& node) {
  static const std::vector<std::string> yes{"yes", "Yes", "YES", "y",    "Y",    "on",
                                            "On",  "ON",  "1",   "True", "TRUE", "true"};
  static const std::vector<std::string> no{"no",  "No",  "NO", "n",     "N",     "off",
                                           "Off", "OFF", "0",  "False", "FALSE", "false"};
  const auto says = [&node](const std::vector<std::string>& words) {
    return std::find(words.begin(), words.end(), node.scalar) != words.end();
  };
  const std::string_view quotes = node.quoted ? " without quotes" : "";
  if (says(yes)) return fmt::format("write `true`{}", quotes);
  if (says(no)) return fmt::format("write `false`{}", quotes);
  return {};
}

std::optional<bool> read_boolean(const Node& node, ReadContext& context) {
  if (node.is_scalar() && !node.quoted) {
    if (node.scalar == "true") return true;
    if (node.scalar == "false") return false;
  }
  report_wrong_type(node, context, "`true` or `false`", boolean_hint(node));
  return std::nullopt;
}

}  // namespace

bool is_scalar(const Node& node) { return node.is_scalar(); }

bool is_section(const Node& node) {
  return node.is_map() && node.find("value") == nullptr && node.find("unit") == nullptr;
}

std::string range_text(Range range) {
  switch (range) {
    case Range::kPositive:
      return " > 0";
    case Range::kNotNegative:
      return " >= 0";
    case Range::kAny:
      break;
  }
  return {};
}

Json number_schema(Range range) {
  Json schema = {{"type", "number"}};
  if (range == Range::kPositive) schema["exclusiveMinimum"] = 0;
  if (range == Range::kNotNegative) schema["minimum"] = 0;
  return schema;
}

bool check_range(double value, Range range, const Node& node, ReadContext& context) {
  const bool positive = range == Range::kPositive;
  if (range == Range::kAny || (positive ? value > 0.0 : value >= 0.0)) return true;
  context.diagnostics.error(Code::kOutOfRange, node.span,
                            fmt::format("{} is {}, but must {}", context.where, describe(node),
                                        positive ? "be positive" : "not be negative"));
  return false;
}

bool check_magnitude(double value, Range range, const Node& node, ReadContext& context) {
  const bool is_too_small = range == Range::kPositive && value < kLeastMagnitude;
  if (!is_too_small && std::abs(value) <= kLargestMagnitude) return true;
  context.diagnostics
      .error(Code::kOutOfRange, node.span,
             fmt::format("{} is {}, but must be {} {:g} in SI units", context.where, describe(node),
                         is_too_small ? "at least" : "at most",
                         is_too_small ? kLeastMagnitude : kLargestMagnitude))
      .with_hint("products of ten such numbers would leave the range of doubles; check the unit");
  return false;
}

std::optional<double> read_number(const Node& node, ReadContext& context) {
  const std::string* text = scalar_text(node, context, "a number", "write for example `0.5`");
  if (text == nullptr) return std::nullopt;
  const Quantity number = parse_number(*text);
  if (!number.error.empty()) {
    context.diagnostics.error(Code::kBadNumber, node.span, context.where + ": " + number.error)
        .with_hint(number.hint);
    return std::nullopt;
  }
  return number.value;
}

Kind<double> number(Range range) {
  return own_kind<double>({
      .text = "number" + range_text(range),
      .schema = number_schema(range),
      .read = [range](const Node& node, ReadContext& context) -> std::optional<double> {
        const std::optional<double> value = read_number(node, context);
        if (!value || !check_range(*value, range, node, context)) return std::nullopt;
        return value;
      },
      .write = [](const double& value) -> Json { return value; },
      .numbers = {Numbers::Form::kScalar, "1"},
  });
}

Kind<int> integer(int minimum, int maximum) {
  Json schema = {{"type", "integer"}, {"minimum", minimum}};
  if (maximum != std::numeric_limits<int>::max()) schema["maximum"] = maximum;
  return own_kind<int>({
      .text = integer_text(minimum, maximum),
      .schema = schema,
      .read = [minimum, maximum](const Node& node, ReadContext& context) -> std::optional<int> {
        return read_integer(node, context, minimum, maximum);
      },
      .write = [](const int& value) -> Json { return value; },
  });
}

Kind<bool> boolean() {
  return own_kind<bool>({
      .text = "`true` or `false`",
      .schema = {{"type", "boolean"}},
      .read = read_boolean,
      .write = [](const bool& value) -> Json { return value; },
  });
}

Kind<std::string> text() {
  return own_kind<std::string>({
      .text = "text",
      .schema = {{"type", "string"}},
      .read = [](const Node& node, ReadContext& context) -> std::optional<std::string> {
        const std::string* text = scalar_text(node, context, "a text", "");
        if (text == nullptr) return std::nullopt;
        return *text;
      },
      .write = [](const std::string& value) -> Json { return value; },
  });
}

Kind<std::string> name() {
  return own_kind<std::string>({
      .text = "name",
      .schema = {{"type", "string"},
                 {"pattern", kNamePattern},
                 {"maxLength", kLongestName},
                 {"not", {{"enum", kReservedWords}}}},
      .read = read_name,
      .write = [](const std::string& value) -> Json { return value; },
  });
}

Kind<std::string> reference_to(std::string what) {
  return own_kind<std::string>({
      .text = what + " name",
      .schema = {{"type", "string"}, {"pattern", kNamePattern}, {"maxLength", kLongestName}},
      .read = [what](const Node& node, ReadContext& context) -> std::optional<std::string> {
        return read_name_form(node, context, fmt::format("a {} name", what));
      },
      .write = [](const std::string& value) -> Json { return value; },
  });
}

Kind<std::string> word(std::vector<std::string> words) {
  return own_kind<std::string>({
      .text = words_text(words, "or"),
      .schema = {{"enum", words}},
      .read = [words](const Node& node, ReadContext& context) -> std::optional<std::string> {
        const std::optional<std::size_t> index = read_word(node, context, words);
        if (!index) return std::nullopt;
        return words[*index];
      },
      .write = [](const std::string& value) -> Json { return value; },
  });
}

}  // namespace twincraft
