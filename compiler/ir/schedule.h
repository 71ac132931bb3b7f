// Inputs that change in steps. A schedule is piecewise constant and right-continuous; its times are
// the events a step always lands on.  Tested by tests/compiler/ir_test.cpp.
#pragma once

#include <vector>

namespace twincraft {

/// value(t) is the value of the last entry with time <= t, and 0 before the first.
struct Schedule {
  struct Entry {
    double time;   // [s]; -infinity for a value that always held
    double value;  // SI unit of what is scheduled
  };
  std::vector<Entry> entries;  // strictly increasing times

  static Schedule constant(double value);
  double at(double time) const;
  bool is_zero() const;

  /// This schedule inside the half-open intervals [start, end), zero outside.
  /// @pre intervals are ordered and do not overlap
  struct Interval {
    double start;  // [s]
    double end;    // [s]
  };
  Schedule during(const std::vector<Interval>& intervals) const;

  Schedule scaled(double factor) const;
};

Schedule operator+(const Schedule& a, const Schedule& b);

/// All finite entry times, sorted, without repeats, inside (0, end).
std::vector<double> event_times(const std::vector<const Schedule*>& schedules, double end);

}  // namespace twincraft
