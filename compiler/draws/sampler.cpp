// See sampler.h.
#include "compiler/draws/sampler.h"

#include <boost/random/sobol.hpp>

namespace twincraft::draws {
namespace {

/// Third word of a counter: what a number is for, so that no two purposes share one.
enum Purpose : std::uint64_t { kValue, kPermutation, kScramble };

constexpr int kLevels = 52;

std::uint64_t random_bits(std::uint64_t first, std::uint64_t second, Purpose purpose, Key key) {
  return philox({first, second, purpose, 0}, key)[0];
}

/// One Feistel network over the numbers of 2 * `half` bits.
std::uint64_t shuffled(std::uint64_t index, int half, Key key) {
  constexpr std::uint64_t kRounds =
      7;  // more than the four of a strong permutation: `half` is small
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  std::uint64_t left = index >> half, right = index & mask;
  for (std::uint64_t round = 0; round < kRounds; ++round) {
    const std::uint64_t next = left ^ (random_bits(right, round, kPermutation, key) & mask);
    left = right;
    right = next;
  }
  return (left << half) | right;
}

}  // namespace

const std::size_t SobolSequence::kMostColumns = boost::random::default_sobol_table::max_dimension;

SobolSequence::SobolSequence(std::size_t columns) : directions_(columns) {
  boost::random::sobol engine(columns);
  for (std::size_t bit = 0; bit < kBits; ++bit) {
    // Boost leaves the origin out, so that its first point is our point 1. The Gray code of this
    // one has the single bit, and so its point is the direction.
    const std::size_t point = (std::size_t{2} << bit) - 1;
    engine.seed(point - 1);
    for (auto& column : directions_) column[bit] = engine();
  }
}

std::uint64_t SobolSequence::at(std::size_t point, std::size_t column) const {
  const std::size_t code = point ^ (point >> 1);
  std::uint64_t bits = 0;
  for (std::size_t bit = 0; bit < kBits; ++bit)
    if ((code >> bit) & 1) bits ^= directions_[column][bit];
  return bits;
}

std::uint64_t permuted(std::uint64_t index, std::uint64_t count, Key key) {
  int half = 0;
  while (std::uint64_t{1} << (2 * half) < count) half += 1;
  // Outside of the range the walk goes on: it is on a circle and comes back into it.
  do {
    index = shuffled(index, half, key);
  } while (index >= count);
  return index;
}

std::uint64_t scrambled(std::uint64_t bits, Key key) {
  std::uint64_t flips = 0;
  for (int level = 0; level < kLevels; ++level) {
    const std::uint64_t above = level == 0 ? 0 : bits >> (64 - level);
    const std::uint64_t coin =
        random_bits(above, static_cast<std::uint64_t>(level), kScramble, key) & 1;
    flips |= coin << (63 - level);
  }
  return (bits ^ flips) & (~std::uint64_t{0} << (64 - kLevels));
}

Sampler::Sampler(Sampling sampling, std::uint64_t seed, std::size_t members,
                 const std::vector<std::string>& names)
    : sampling_(sampling), members_(members) {
  for (const std::string& name : names) keys_.push_back(key_of(seed, name));
  if (sampling == Sampling::kSobol && !names.empty()) sobol_.emplace_back(names.size());
}

double Sampler::uniform(std::size_t member, std::size_t column) const {
  const Key key = keys_[column];
  if (sampling_ == Sampling::kSobol)
    return unit_number(scrambled(sobol_.front().at(member, column), key));
  const std::uint64_t bits = random_bits(member, 0, kValue, key);
  if (sampling_ == Sampling::kRandom) return unit_number(bits);
  // 30 bits of place in the stratum: with them the sum is exact, and no quotient leaves its
  // stratum.
  const double place = (static_cast<double>(bits >> 34) + 0.5) * 0x1p-30;
  return (static_cast<double>(permuted(member, members_, key)) + place) /
         static_cast<double>(members_);
}

}  // namespace twincraft::draws
