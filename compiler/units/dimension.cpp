// Names of the dimensions that occur in spacecraft specs. Tested by tests/compiler/units_test.cpp.
#include "compiler/units/dimension.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace twincraft {
namespace {

struct Name {
  Dimension dimension;
  std::string_view text;
};

const std::vector<Name>& names() {
  static const std::vector<Name> table{
      {{}, "a pure number"},
      {{{"kg", 1}}, "a mass"},
      {{{"m", 1}}, "a length"},
      {{{"s", 1}}, "a time"},
      {{{"rad", 1}}, "an angle"},
      {{{"K", 1}}, "a temperature"},
      {{{"m", 2}}, "an area"},
      {{{"m", 3}}, "a volume"},
      {{{"s", -1}}, "a frequency"},
      {{{"m", 1}, {"s", -1}}, "a speed"},
      {{{"m", 1}, {"s", -2}}, "an acceleration"},
      {{{"rad", 1}, {"s", -1}}, "an angular rate"},
      {{{"rad", 1}, {"s", -2}}, "an angular acceleration"},
      {{{"kg", 1}, {"m", -3}}, "a density"},
      {{{"kg", 1}, {"m", 2}}, "a moment of inertia"},
      {{{"kg", 1}, {"m", 1}, {"s", -2}}, "a force"},
      {{{"kg", 1}, {"m", 1}, {"s", -1}}, "an impulse"},
      {{{"kg", 1}, {"m", 2}, {"s", -2}}, "a torque"},
      {{{"kg", 1}, {"m", 2}, {"s", -1}}, "an angular momentum"},
      {{{"kg", 1}, {"m", 2}, {"s", -3}}, "a power"},
      {{{"kg", 1}, {"m", -1}, {"s", -2}}, "a pressure"},
      {{{"kg", 1}, {"s", -2}}, "a stiffness"},
      {{{"kg", 1}, {"s", -1}}, "a damping or mass flow"},
      {{{"kg", 1}, {"m", 2}, {"s", -2}, {"rad", -1}}, "a torsional stiffness"},
      {{{"kg", 1}, {"m", 2}, {"s", -1}, {"rad", -1}}, "a torsional damping"},
      {{{"m", 3}, {"s", -2}}, "a gravitational parameter"},
  };
  return table;
}

int power_of(const Dimension& dimension, const std::string& base) {
  const auto found = dimension.find(base);
  return found == dimension.end() ? 0 : found->second;
}

}  // namespace

bool fits(const Dimension& given, const Dimension& expected) {
  if (given == expected) return true;
  Dimension without_radian = expected;
  without_radian.erase("rad");
  return power_of(expected, "rad") < 0 && given == without_radian;
}

std::string describe(const Dimension& dimension) {
  const auto found = std::ranges::find(names(), dimension, &Name::dimension);
  if (found != names().end()) return std::string(found->text);
  std::string text = "a quantity in";
  for (const auto& [base, power] : dimension) {
    text += power == 1 ? fmt::format(" {}", base) : fmt::format(" {}{}", base, power);
  }
  return text;
}

}  // namespace twincraft
