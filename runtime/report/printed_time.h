// Times as files show them. A run lands on index * step, which in doubles is 0.30000000000000004
// for the third tenth of a second, and 0.3 for the sixth twentieth: two runs would not join on
// time. Tested by tests/runtime/printed_time_test.cpp.
#pragma once

#include <cstdint>

namespace twincraft {

class PrintedTime {
 public:
  /// @param step  of the run [s]
  explicit PrintedTime(double step);

  /// The double nearest to the decimal multiple of the step that `time` [s] stands for; `time`
  /// itself where it is no multiple, or where the step is no decimal of at most nine digits.
  double operator()(double time) const;

 private:
  double step_;
  std::int64_t digits_ = 0;  // the step is digits * 10^exponent; 0: it is no short decimal
  int exponent_ = 0;
  double power_ = 1.0;  // 10^-exponent
};

}  // namespace twincraft
