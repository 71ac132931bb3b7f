#include "runtime/report/page/inline_json.h"

#include <nlohmann/json.hpp>

namespace twincraft {

std::string inline_json(const nlohmann::ordered_json& json) {
  const std::string text =
      json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size() + text.size() / 64);
  // In JSON a `<` stands in strings alone, where it may be written so.
  for (const char c : text) c == '<' ? (safe += "\\u003c") : (safe += c);
  return safe;
}

}  // namespace twincraft
