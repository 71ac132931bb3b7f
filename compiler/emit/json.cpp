// See json.h. Tested by tests/compiler/emit_test.cpp.
#include "compiler/emit/json.h"

#include <algorithm>

#include "compiler/ir/number.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

void write(const Json& value, const std::string& indent, std::string& out) {
  if (fits_one_line(value)) {
    out += one_line(value);
    return;
  }
  const std::string inner = indent + "  ";
  out += value.is_object() ? "{\n" : "[\n";
  bool first = true;
  for (const auto& [key, item] : value.items()) {
    if (!first) out += ",\n";
    first = false;
    out += inner;
    if (value.is_object()) out += Json(key).dump() + ": ";
    write(item, inner, out);
  }
  out += "\n" + indent + (value.is_object() ? "}" : "]");
}

}  // namespace

std::string json_scalar(const Json& value) {
  return value.is_number_float() ? shortest(value.get<double>()) : value.dump();
}

bool fits_one_line(const Json& value) {
  if (value.is_object()) return value.empty();
  return !value.is_array() || std::all_of(value.begin(), value.end(), fits_one_line);
}

std::string one_line(const Json& value) {
  if (!value.is_array()) return json_scalar(value);
  std::string out = "[";
  for (const Json& item : value) out += (out.size() > 1 ? ", " : "") + one_line(item);
  return out + "]";
}

std::string json_text(const Json& value) {
  std::string out;
  write(value, "", out);
  return out + "\n";
}

}  // namespace twincraft
