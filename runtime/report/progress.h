// One line on the terminal that says what is being done, how far it is and how long it will take.
// Tested by tests/runtime/report_test.cpp.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

namespace twincraft {

/// `mujoco  [#########...........]  45 %  12.1 s left`; no estimate before 2 % or when done.
std::string progress_line(std::string_view phase, double fraction, double elapsed_seconds);

/// Draws over itself; silent in its first half second, so that short runs show nothing.
class ProgressBar {
 public:
  explicit ProgressBar(std::FILE* terminal) : terminal_(terminal) {}
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(std::string_view phase, double fraction);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::FILE* terminal_;
  std::string phase_;
  Clock::time_point begin_ = Clock::now();  // of everything
  Clock::time_point phase_begin_ = begin_;
  Clock::time_point last_drawn_ = begin_;
  bool drawn_ = false;
};

}  // namespace twincraft
