// Any text is a finite quantity or an error with words. The first byte chooses the unit asked for.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "compiler/units/units.h"
#include "tests/fuzz/claim.h"

using namespace twincraft;

namespace {

constexpr std::array<SiUnit, 12> kUnits{"kg",      "m",   "s",         "rad",   "N m",   "kg m2",
                                        "N m/rad", "m/s", "N m s/rad", "m3/s2", "rad/s", "1"};

void check(const Quantity& quantity) {
  fuzz::claim(quantity.error.empty() ? std::isfinite(quantity.value) : true);
  fuzz::claim(quantity.hint.empty() || !quantity.error.empty());
  fuzz::claim(!(quantity.value == 0.0 && std::signbit(quantity.value)));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  check(parse_quantity(text, kUnits[data[0] % kUnits.size()]));
  check(parse_number(text));
  check(unit_factor(text, kUnits[data[0] % kUnits.size()]));
  return 0;
}
