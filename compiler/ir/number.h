// How numbers leave the program: the shortest text that reads back as the same double.
// Tested by tests/compiler/ir_test.cpp.
#pragma once

#include <string>

namespace twincraft {

/// `0.1`, `1e-06`, `7e+06`: std::to_chars, so locale never matters. @pre finite
std::string shortest(double value);

}  // namespace twincraft
