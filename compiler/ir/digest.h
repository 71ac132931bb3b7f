// What tells whether two texts are the same. Tested by tests/compiler/pipeline_test.cpp.
#pragma once

#include <string>

namespace twincraft {

/// SHA-256 of `text`, 64 lower-case hexadecimal digits.
std::string sha256(const std::string& text);

}  // namespace twincraft
