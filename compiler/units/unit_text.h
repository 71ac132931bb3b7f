// What the text of a unit may look like: names with powers, joined by products and quotients.
// Everything else UDUNITS reads - numbers, offsets, logarithms, dates - ends here.
// Tested by tests/compiler/units_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace twincraft {

struct UnitText {
  std::string ascii;               // for UDUNITS: `µ`, `²`, `·`, `°` replaced
  std::vector<std::string> names;  // in order: "kg m2/s" has kg, m, s
};

/// None when `text` is not written like a unit.
std::optional<UnitText> read_unit_text(std::string_view text);

}  // namespace twincraft
