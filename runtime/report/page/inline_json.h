// JSON inside a page.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace twincraft {

/// Text that may stand inside a script element: no `<` in it.
std::string inline_json(const nlohmann::ordered_json& json);

}  // namespace twincraft
