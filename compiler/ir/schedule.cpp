// See schedule.h. Tested by tests/compiler/ir_test.cpp.
#include "compiler/ir/schedule.h"

#include <algorithm>
#include <limits>

namespace twincraft {

Schedule Schedule::constant(double value) {
  return {{{-std::numeric_limits<double>::infinity(), value}}};
}

double Schedule::at(double time) const {
  const auto after = std::upper_bound(entries.begin(), entries.end(), time,
                                      [](double t, const Entry& entry) { return t < entry.time; });
  return after == entries.begin() ? 0.0 : std::prev(after)->value;
}

bool Schedule::is_zero() const {
  return std::all_of(entries.begin(), entries.end(),
                     [](const Entry& entry) { return entry.value == 0.0; });
}

Schedule Schedule::during(const std::vector<Interval>& intervals) const {
  Schedule gated;
  for (const Interval& interval : intervals) {
    // Two intervals that touch share one event: the end of the first is the start of the second.
    if (!gated.entries.empty() && gated.entries.back().time == interval.start) {
      gated.entries.pop_back();
    }
    gated.entries.push_back({interval.start, at(interval.start)});
    for (const Entry& entry : entries) {
      if (entry.time > interval.start && entry.time < interval.end) gated.entries.push_back(entry);
    }
    gated.entries.push_back({interval.end, 0.0});
  }
  return gated;
}

Schedule Schedule::scaled(double factor) const {
  Schedule product = *this;
  for (Entry& entry : product.entries) entry.value *= factor;
  return product;
}

Schedule operator+(const Schedule& a, const Schedule& b) {
  std::vector<double> times;
  for (const Schedule* schedule : {&a, &b}) {
    for (const Schedule::Entry& entry : schedule->entries) times.push_back(entry.time);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  Schedule sum;
  for (const double time : times) sum.entries.push_back({time, a.at(time) + b.at(time)});
  return sum;
}

std::vector<double> event_times(const std::vector<const Schedule*>& schedules, double end) {
  std::vector<double> times;
  for (const Schedule* schedule : schedules) {
    for (const Schedule::Entry& entry : schedule->entries) {
      if (entry.time > 0.0 && entry.time < end) times.push_back(entry.time);
    }
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace twincraft
