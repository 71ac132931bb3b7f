// See decimate.h. Tested by tests/runtime/html_test.cpp.
#include "runtime/report/html/decimate.h"

#include <cmath>

namespace twincraft {

Decimation::Decimation(std::size_t samples, std::size_t points)
    : samples_(samples), buckets_(points / 2), thins_(samples > points) {}

std::size_t Decimation::points() const { return thins_ ? 2 * buckets_ : samples_; }

std::vector<double> Decimation::instants(const Column& column) const {
  std::vector<double> values;
  values.reserve(points());
  if (!thins_) {
    for (std::size_t i = 0; i < samples_; ++i) values.push_back(column(i));
    return values;
  }
  for (std::size_t bucket = 0; bucket < buckets_; ++bucket) {
    values.push_back(column(begin_of(bucket)));
    values.push_back(column(begin_of(bucket + 1) - 1));
  }
  return values;
}

std::vector<double> Decimation::extremes(const Column& column) const {
  if (!thins_) return instants(column);
  std::vector<double> values;
  values.reserve(points());
  for (std::size_t bucket = 0; bucket < buckets_; ++bucket) {
    const std::size_t begin = begin_of(bucket);
    double least = column(begin), greatest = least;
    bool greatest_last = true;
    // Written so that a NaN, once met, stays.
    for (std::size_t i = begin + 1; i < begin_of(bucket + 1) && !std::isnan(least); ++i) {
      const double value = column(i);
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
    values.push_back(greatest_last ? least : greatest);
    values.push_back(greatest_last ? greatest : least);
  }
  return values;
}

}  // namespace twincraft
