// See number.h. Tested by tests/compiler/ir_test.cpp.
#include "compiler/ir/number.h"

#include <array>
#include <charconv>

namespace twincraft {

std::string shortest(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

}  // namespace twincraft
