// Sobol' indices: which share of an output's variance an input carries, alone (first order) or with
// others (total). The inputs are taken to be independent.
//
// Intervals are normal, by the spread of the estimate over members drawn again with replacement.
// They are made for members drawn at random; for Latin hypercubes and Sobol' points they are too
// wide. An estimate may come out below 0: that is its noise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace twincraft::statistics {

struct Index {
  double value = 0.0;
  double lower = 0.0, upper = 0.0;  // of 95 % confidence
};

struct Resampling {
  std::size_t times = 200;
  std::uint64_t seed = 1;
};

/// First-order indices from any independent draws: the inputs' ranges are cut into sqrt(n) classes,
/// at most 64, of as many members each, and the variance between the classes' means, less what the
/// noise within them adds to it, is divided by that of all. It misses what happens within a class.
/// Rank-based estimators (Chatterjee; Gamboa and others 2022) miss less, but a bootstrap of these
/// is not consistent (Lin and Han 2024), so their intervals would be wrong. Takes
/// inputs * n * (log n + times) operations.
/// Nothing: a hole (NaN) anywhere, fewer than 16 members, or an output that is the same in all. An
/// input that is the same in all has the index 0.
/// @param inputs  a column each, as long as `output`
std::optional<std::vector<Index>> sobol_given_data(std::span<const std::span<const double>> inputs,
                                                   std::span<const double> output,
                                                   const Resampling& resampling = {});

/// Outputs of the n (d + 2) members of Saltelli's design: two independent sets A and B of n, and
/// for each input A with that input's column from B.
struct SaltelliDesign {
  std::span<const double> a, b;
  std::vector<std::span<const double>> a_with_b;  // one per input
};
struct SaltelliIndices {
  std::vector<Index> first, total;
};
/// First order by Saltelli and others 2010, total by Jansen 1999. Nothing: a hole (NaN) anywhere,
/// fewer than 16 members, or an output that is the same in all.
std::optional<SaltelliIndices> sobol_saltelli(const SaltelliDesign& design,
                                              const Resampling& resampling = {});

}  // namespace twincraft::statistics
