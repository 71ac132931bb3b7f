#include "compiler/emit/python_text.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "compiler/ir/number.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

std::string scalar(const Json& value) {
  if (value.is_null()) return "None";
  if (value.is_boolean()) return value.get<bool>() ? "True" : "False";
  if (value.is_number_integer()) return std::to_string(value.get<long long>());
  if (value.is_number()) return shortest(value.get<double>());
  return value.dump(-1, ' ', true);  // JSON's text, in ASCII, is Python's
}

std::string one_line(const Json& value) {
  if (!value.is_structured()) return scalar(value);
  std::string text;
  for (const auto& [key, item] : value.items()) {
    if (!text.empty()) text += ", ";
    if (value.is_object()) text += scalar(key) + ": ";
    text += one_line(item);
  }
  return value.is_object() ? "{" + text + "}" : "[" + text + "]";
}

std::size_t column_of(const std::string& text) { return text.size() - (text.rfind('\n') + 1); }

/// Appends `value` where `text` ends: on the line where it fits, else part by part on lines that
/// are filled. @param after  how many characters its line ends with
void write(const Json& value, std::size_t indent, std::size_t after, std::string& text) {
  const std::string line = one_line(value);
  if (!value.is_structured() || value.empty() ||
      column_of(text) + line.size() + after <= kScriptLine) {
    text += line;
    return;
  }
  text += value.is_object() ? '{' : '[';
  // What has one part goes on where it is.
  const std::size_t inner = value.size() == 1 ? indent : indent + 4;
  bool first = true;
  std::size_t left = value.size();
  for (const auto& [key, item] : value.items()) {
    --left;
    const std::string lead = value.is_object() ? scalar(key) + ": " : "";
    const std::size_t tail = left == 0 ? 1 + after : 1;
    const std::size_t size = lead.size() + one_line(item).size() + tail;
    const bool fits = column_of(text) + 1 + size <= kScriptLine;
    if (value.size() > 1) text += first || !fits ? "\n" + std::string(inner, ' ') : " ";
    text += lead;
    write(item, inner, tail, text);
    if (left > 0) text += ',';
    first = false;
  }
  text += value.is_object() ? '}' : ']';
}

/// As a docstring and a comment may hold it.
std::string harmless(std::string_view text) {
  std::string quoted = Json(std::string(text)).dump(-1, ' ', true, Json::error_handler_t::replace);
  return quoted.substr(1, quoted.size() - 2);
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words(1);
  for (const char each : text) {
    if (each == ' ')
      words.emplace_back();
    else
      words.back() += each;
  }
  std::erase(words, "");
  return words;
}

}  // namespace

std::string assignment(std::string_view name, const Json& value, std::string_view comment) {
  std::string text = fmt::format("{} = ", name);
  write(value, 0, 0, text);
  text += '\n';
  if (comment.empty()) return text;
  const std::string behind = fmt::format("  # {}", comment);
  const std::size_t end = text.find('\n');
  if (end + behind.size() <= kScriptLine) return text.insert(end, behind);
  return fmt::format("# {}: {}\n", name, comment) + text;
}

std::string with(std::string_view text, const Words& words) {
  std::string out(text);
  for (const auto& [mark, word] : words)
    for (std::size_t at = out.find(mark); at != std::string::npos;
         at = out.find(mark, at + word.size()))
      out.replace(at, mark.size(), word);
  return out;
}

std::string wrapped(std::string_view text, std::string_view first, std::string_view indent) {
  return filled(harmless(text), first, indent);
}

std::string filled(std::string_view words, std::string_view first, std::string_view indent) {
  std::string lines(first);
  bool is_start = true;
  for (const std::string& word : words_of(std::string(words))) {
    if (!is_start && column_of(lines) + 1 + word.size() > kScriptLine) {
      lines += '\n';
      lines += indent;
      is_start = true;
    }
    if (!is_start) lines += ' ';
    lines += word;
    is_start = false;
  }
  return lines + "\n";
}

}  // namespace twincraft
