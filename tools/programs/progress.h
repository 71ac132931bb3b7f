// One line on the terminal that says what is being done, how far it is and how long it will take.
// Tested by tests/runtime/report_test.cpp.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

namespace twincraft {

/// `mujoco  [#########...........]  45 %  t = 54 s of 120 s  12.1 s left`; no estimate before 2 %
/// or when done.
/// @param duration  of what is simulated [s]; 0: nothing is
std::string progress_line(std::string_view phase, double fraction, double elapsed_seconds,
                          double duration = 0.0);

/// Draws over itself; silent in its first half second, so that short runs show nothing.
class ProgressBar {
 public:
  /// @param duration  of the run that engines simulate [s]; 0: no single run
  explicit ProgressBar(std::FILE* terminal, double duration = 0.0)
      : terminal_(terminal), duration_(duration) {}
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// @param phase  its first word is the phase, what follows may change within it
  void show(std::string_view phase, double fraction);
  /// A line that stays, above the bar.
  void leave(std::string_view line);
  void clear();

 private:
  void write(std::string_view text);

  using Clock = std::chrono::steady_clock;
  std::FILE* terminal_;
  double duration_;
  std::string phase_;
  Clock::time_point begin_ = Clock::now();  // of everything
  Clock::time_point phase_begin_ = begin_;
  Clock::time_point last_drawn_ = begin_;
  bool drawn_ = false;
};

}  // namespace twincraft
