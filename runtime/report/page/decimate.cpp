// See decimate.h. How many samples will come is not known, and a run may end early. So there are
// several times more buckets than are shown; when all are full, neighbours are merged. At the end
// the shown ones are put together of them. Tested by tests/runtime/html_test.cpp.
#include "runtime/report/page/decimate.h"

#include <algorithm>
#include <cmath>

namespace twincraft {
namespace {

// Buckets kept for one that is shown: at least two, so that shown ones differ little in width.
constexpr std::size_t kFinest = 8, kCoarsest = 2;
constexpr std::size_t kMostRanges = 1'000'000;  // 24 MB

std::size_t fineness(std::size_t columns, std::size_t shown) {
  return std::clamp(kMostRanges / std::max<std::size_t>(1, columns * shown), kCoarsest, kFinest);
}

}  // namespace

void Decimator::Range::see(double value) {
  if (std::isnan(least)) return;  // a NaN, once met, stays
  if (std::isnan(value)) {
    least = greatest = value;
  } else if (value > greatest) {
    greatest = value;
    greatest_last = true;
  } else if (value < least) {
    least = value;
    greatest_last = false;
  }
}

void Decimator::Range::append(const Range& later) {
  if (later.greatest_last) {
    see(later.least);
    see(later.greatest);
  } else {
    see(later.greatest);
    see(later.least);
  }
}

Decimator::Decimator(std::size_t columns, std::size_t points)
    : columns_(columns),
      points_(points),
      most_buckets_((fineness(columns, points / 2) * (points / 2) + 1) / 2 * 2) {}

void Decimator::add_bucket(double time, std::span<const double> values) {
  times_.push_back({time, time});
  for (const double value : values) ranges_.push_back({value, value, true});
  in_last_ = 1;
}

void Decimator::halve() {
  const std::size_t half = times_.size() / 2;
  for (std::size_t i = 0; i < half; ++i) {
    times_[i] = {times_[2 * i].first, times_[2 * i + 1].last};
    for (std::size_t c = 0; c < columns_; ++c) {
      Range merged = ranges_[2 * i * columns_ + c];
      merged.append(ranges_[(2 * i + 1) * columns_ + c]);
      ranges_[i * columns_ + c] = merged;
    }
  }
  times_.resize(half);
  ranges_.resize(half * columns_, Range{0.0, 0.0, true});
  width_ *= 2;
}

void Decimator::take(double time, std::span<const double> values) {
  ++samples_;
  if (!times_.empty() && in_last_ < width_) {
    times_.back().last = time;
    Range* range = &ranges_[ranges_.size() - columns_];
    for (const double value : values) (range++)->see(value);
    ++in_last_;
    return;
  }
  if (times_.size() == most_buckets_) halve();
  add_bucket(time, values);
}

std::size_t Decimator::points() const { return thins() ? 2 * shown_buckets() : samples_; }

std::size_t Decimator::begin_of(std::size_t shown) const {
  return shown * times_.size() / shown_buckets();
}

std::vector<double> Decimator::times() const {
  std::vector<double> times;
  if (!thins()) {
    for (const Interval& bucket : times_) times.push_back(bucket.first);
    return times;
  }
  for (std::size_t i = 0; i < shown_buckets(); ++i) {
    times.push_back(times_[begin_of(i)].first);
    times.push_back(times_[begin_of(i + 1) - 1].last);
  }
  return times;
}

std::vector<double> Decimator::extremes(std::size_t column) const {
  std::vector<double> values;
  if (!thins()) {
    for (std::size_t i = 0; i < times_.size(); ++i)
      values.push_back(ranges_[i * columns_ + column].least);
    return values;
  }
  for (std::size_t i = 0; i < shown_buckets(); ++i) {
    Range all = ranges_[begin_of(i) * columns_ + column];
    for (std::size_t k = begin_of(i) + 1; k < begin_of(i + 1); ++k)
      all.append(ranges_[k * columns_ + column]);
    values.push_back(all.greatest_last ? all.least : all.greatest);
    values.push_back(all.greatest_last ? all.greatest : all.least);
  }
  return values;
}

}  // namespace twincraft
