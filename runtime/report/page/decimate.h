// Long histories made short for a picture while their samples come, with every extreme kept:
// samples go into buckets of time, and of each bucket a column shows its least and its greatest
// value, in the order they came. All columns share the same times (a bucket's first and last), so
// an extreme is moved by less than a bucket, which is less than the width of a line on the screen.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace twincraft {

class Decimator {
 public:
  /// @param points  how many of each column may be shown, at least 4
  Decimator(std::size_t columns, std::size_t points);

  /// @param values  one per column
  void take(double time, std::span<const double> values);

  std::size_t samples() const { return samples_; }
  bool thins() const { return samples_ > points_; }
  std::size_t points() const;  // that are shown

  /// No extremes, the same sample for every column.
  std::vector<double> times() const;
  /// Least and greatest of every bucket; where one is NaN, the bucket is.
  std::vector<double> extremes(std::size_t column) const;

 private:
  struct Range {
    double least, greatest;
    bool greatest_last;
    void see(double value);
    void append(const Range& later);
  };
  struct Interval {
    double first, last;  // [s]
  };

  void add_bucket(double time, std::span<const double> values);
  void halve();
  std::size_t shown_buckets() const { return points_ / 2; }
  std::size_t begin_of(std::size_t shown) const;

  std::size_t columns_, points_;
  std::size_t most_buckets_;  // several to each that is shown
  std::size_t width_ = 1;     // samples in a bucket
  std::size_t in_last_ = 0;   // of the last bucket's, taken so far
  std::size_t samples_ = 0;
  std::vector<Interval> times_;  // per bucket
  std::vector<Range> ranges_;    // per bucket and column
};

}  // namespace twincraft
