// Uniform numbers of a campaign: one for every member and column. Each is a function of the seed,
// the member and the name of the column, so that no order of asking and no other column plays a
// part; of a design (Latin hypercube, Sobol') also of what makes the design. Tested by
// tests/compiler/draws_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "compiler/draws/philox.h"
#include "compiler/ir/campaign.h"

namespace twincraft::draws {

/// Direction numbers of a Sobol' sequence, from Boost: those of Joe and Kuo. The points are in the
/// order of Gray codes; point 0 is the origin.
class SobolSequence {
 public:
  static const std::size_t kMostColumns;
  static constexpr std::size_t kMostPoints = std::size_t{1} << 20;

  /// @pre 0 < columns <= kMostColumns
  explicit SobolSequence(std::size_t columns);
  /// As a fraction of 2^64. @pre point < kMostPoints
  std::uint64_t at(std::size_t point, std::size_t column) const;

 private:
  static constexpr std::size_t kBits = 20;  // of the number of a point
  std::vector<std::array<std::uint64_t, kBits>> directions_;
};

class Sampler {
 public:
  /// @param names  of the columns, each once
  /// @pre with kSobol no more columns and members than a SobolSequence has
  Sampler(Sampling sampling, std::uint64_t seed, std::size_t members,
          const std::vector<std::string>& names);

  /// In the open interval (0, 1). @pre member < members
  double uniform(std::size_t member, std::size_t column) const;

 private:
  Sampling sampling_;
  std::size_t members_;
  std::vector<Key> keys_;             // of the columns
  std::vector<SobolSequence> sobol_;  // one with kSobol, else none
};

/// A permutation of 0 to count - 1, without a table. @pre index < count
std::uint64_t permuted(std::uint64_t index, std::uint64_t count, Key key);

/// `bits` after a nested uniform scramble (Owen 1995): each of the leading 52 bits is flipped or
/// not by a coin that belongs to all bits above it. The rest is dropped.
std::uint64_t scrambled(std::uint64_t bits, Key key);

}  // namespace twincraft::draws
