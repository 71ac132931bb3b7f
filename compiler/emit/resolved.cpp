// YAML in block style; lists of plain values stay on one line. Tested by
// tests/compiler/emit_test.cpp.
#include "compiler/emit/resolved.h"

#include <regex>

#include "compiler/emit/json.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

/// A word that no YAML reader takes for anything but text needs no quotes.
bool is_plain_word(const Json& value) {
  static const std::regex word("[A-Za-z][A-Za-z0-9_/-]*");
  static const std::regex other("y|yes|n|no|on|off|true|false|null", std::regex::icase);
  if (!value.is_string()) return false;
  const auto& text = value.get_ref<const std::string&>();
  return text.size() <= 64 && std::regex_match(text, word) && !std::regex_match(text, other);
}

void write(const Json& value, const std::string& indent, std::string& out);

void write_entries(const Json& map, const std::string& indent, std::string& out) {
  bool first = true;
  for (const auto& [key, item] : map.items()) {
    if (!first) out += indent;
    first = false;
    out += key + ":";
    write(item, indent, out);
  }
}

/// What follows `key:` or `-`, with its line end.
void write(const Json& value, const std::string& indent, std::string& out) {
  if (fits_one_line(value)) {
    out += ' ';
    out += is_plain_word(value) ? value.get<std::string>() : one_line(value);
    out += '\n';
    return;
  }
  const std::string inner = indent + "  ";
  if (value.is_object()) {
    out += "\n" + inner;
    write_entries(value, inner, out);
    return;
  }
  out += '\n';
  for (const Json& item : value) {
    out += inner + "-";
    if (item.is_object() && !item.empty()) {
      out += ' ';
      write_entries(item, inner + "  ", out);
    } else {
      write(item, inner + "  ", out);
    }
  }
}

}  // namespace

std::string emit_resolved(const Json& spec) {
  std::string out;
  write_entries(spec, "", out);
  return out;
}

}  // namespace twincraft
