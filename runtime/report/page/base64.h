// Base64, for hashes in a policy and for columns of numbers in a page.
// Tested by tests/runtime/html_test.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace twincraft {

std::string base64(std::string_view bytes);

/// Little-endian doubles: exact, and half as long as the shortest decimals.
std::string base64(const std::vector<double>& values);

/// `sha256-...` as Content-Security-Policy writes it.
std::string csp_hash(std::string_view text);

}  // namespace twincraft
