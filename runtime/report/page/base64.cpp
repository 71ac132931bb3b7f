// See base64.h. Tested by tests/runtime/html_test.cpp.
#include "runtime/report/page/base64.h"

#include <openssl/evp.h>

#include <array>
#include <bit>
#include <stdexcept>

namespace twincraft {

static_assert(std::endian::native == std::endian::little, "columns of numbers are little-endian");

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) -> unsigned {
      return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U;
    };
    const unsigned group = byte(0) << 16U | byte(1) << 8U | byte(2);
    for (unsigned k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? kDigits[group >> (18U - 6U * k) & 63U] : '=';
  }
  return text;
}

std::string base64(const std::vector<double>& values) {
  return base64(std::string_view(reinterpret_cast<const char*>(values.data()),
                                 values.size() * sizeof(double)));
}

std::string csp_hash(std::string_view text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  if (EVP_Digest(text.data(), text.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("SHA-256 is not available");
  return "sha256-" + base64(std::string_view(reinterpret_cast<const char*>(digest.data()), length));
}

}  // namespace twincraft
