// See philox.h.
#include "compiler/draws/philox.h"

#include <charconv>

#include "compiler/ir/digest.h"

namespace twincraft::draws {
namespace {

constexpr int kRounds = 10;
constexpr std::uint64_t kMultiplier0 = 0xD2E7470EE14C6C93, kMultiplier1 = 0xCA5A826395121157;
constexpr std::uint64_t kWeyl0 = 0x9E3779B97F4A7C15, kWeyl1 = 0xBB67AE8584CAA73B;

struct Product {
  std::uint64_t high, low;
};

Product product(std::uint64_t a, std::uint64_t b) {
  __extension__ using Wide = unsigned __int128;
  const Wide wide = static_cast<Wide>(a) * b;
  return {static_cast<std::uint64_t>(wide >> 64), static_cast<std::uint64_t>(wide)};
}

}  // namespace

Block philox(Block counter, Key key) {
  for (int round = 0; round < kRounds; ++round) {
    const Product p0 = product(kMultiplier0, counter[0]);
    const Product p1 = product(kMultiplier1, counter[2]);
    counter = {p1.high ^ counter[1] ^ key[0], p1.low, p0.high ^ counter[3] ^ key[1], p0.low};
    key[0] += kWeyl0;
    key[1] += kWeyl1;
  }
  return counter;
}

Key key_of(std::uint64_t seed, const std::string& name) {
  const std::string digest = sha256(name);
  std::uint64_t bits = 0;
  std::from_chars(digest.data(), digest.data() + 16, bits, 16);
  return {seed, bits};
}

double unit_number(std::uint64_t bits) { return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52; }

}  // namespace twincraft::draws
