// See base64.h. Tested by tests/runtime/html_test.cpp.
#include "runtime/report/page/base64.h"

#include <openssl/evp.h>

#include <array>
#include <bit>
#include <stdexcept>

namespace twincraft {

static_assert(std::endian::native == std::endian::little, "columns of numbers are little-endian");

std::string base64(std::string_view bytes) {
  const std::size_t size = (bytes.size() + 2) / 3 * 4;
  std::string text(size + 1, '\0');  // OpenSSL ends it with a NUL
  EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                  reinterpret_cast<const unsigned char*>(bytes.data()),
                  static_cast<int>(bytes.size()));
  text.resize(size);
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
