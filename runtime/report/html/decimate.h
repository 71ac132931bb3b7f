// Long histories made short for a picture, with every extreme kept: the samples are dealt into
// buckets, and of each bucket a column shows its least and its greatest value, in the order they
// came. All columns share the same times (a bucket's first and last), so an extreme is moved by
// less than a bucket, which is less than the width of a line on the screen.
// Tested by tests/runtime/html_test.cpp.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace twincraft {

/// A quantity at sample `i`.
using Column = std::function<double(std::size_t i)>;

class Decimation {
 public:
  /// @param samples  how many there are
  /// @param points   how many may be shown, at least 4
  Decimation(std::size_t samples, std::size_t points);

  bool thins() const { return thins_; }
  std::size_t points() const;

  /// Values at the instants: no extremes, the same sample for every such column.
  std::vector<double> instants(const Column& column) const;

  /// Least and greatest of every bucket; where one is NaN, the bucket is.
  std::vector<double> extremes(const Column& column) const;

 private:
  std::size_t begin_of(std::size_t bucket) const { return bucket * samples_ / buckets_; }

  std::size_t samples_, buckets_;
  bool thins_;
};

}  // namespace twincraft
