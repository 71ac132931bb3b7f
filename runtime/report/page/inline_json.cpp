#include "runtime/report/page/inline_json.h"

#include <nlohmann/json.hpp>
#include <string_view>

namespace twincraft {

std::string inline_json(const nlohmann::ordered_json& json) {
  const std::string text =
      json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size() + text.size() / 64);
  // In JSON a `<` stands in strings alone, where it may be written so.
  std::string_view rest = text;
  for (std::size_t tag = rest.find('<'); tag != std::string_view::npos; tag = rest.find('<')) {
    safe += rest.substr(0, tag);
    safe += "\\u003c";
    rest.remove_prefix(tag + 1);
  }
  return safe += rest;
}

}  // namespace twincraft
