// UTF-8, one character at a time: what the loader refuses and the printer escapes.
// Tested by tests/compiler/diag_test.cpp.
#pragma once

#include <cstddef>
#include <string_view>

namespace twincraft {

struct Utf8Character {
  char32_t code = 0;
  std::size_t length = 0;  // in bytes; 0: the byte begins no UTF-8 character
};

/// The character that begins at byte `at` < `text.size()`. Overlong forms, surrogates and values
/// above U+10FFFF are no characters.
Utf8Character decode_utf8(std::string_view text, std::size_t at);

/// C0, DEL and C1: characters that drive a terminal instead of showing.
bool is_control(char32_t code);

}  // namespace twincraft
