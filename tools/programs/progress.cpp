// See progress.h. Tested by tests/runtime/report_test.cpp.
#include "tools/programs/progress.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/diag/terminal.h"
#include "compiler/ir/engine_kind.h"
#include "runtime/report/words.h"

namespace twincraft {
namespace {

using namespace std::chrono_literals;

constexpr auto kQuiet = 500ms;
constexpr auto kInterval = 100ms;
constexpr int kCells = 20;
constexpr const char* kEraseLine = "\r\x1b[K";

double seconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

std::string progress_line(std::string_view phase, double fraction, double elapsed_seconds,
                          double duration) {
  fraction = std::clamp(fraction, 0.0, 1.0);
  const int filled = static_cast<int>(fraction * kCells);
  std::string line = fmt::format("{:<7} [{}{}] {:>3.0f} %", phase, std::string(filled, '#'),
                                 std::string(kCells - filled, '.'), 100.0 * fraction);
  if (duration > 0.0)
    line += fmt::format("  t = {:.4g} s of {:.4g} s", fraction * duration, duration);
  if (fraction >= 0.02 && fraction < 1.0)
    line += fmt::format("  {} left",
                        twincraft::duration(elapsed_seconds * (1.0 - fraction) / fraction));
  return line;
}

void ProgressBar::show(std::string_view phase, double fraction) {
  const Clock::time_point now = Clock::now();
  // Of `timing trial 3 of 12` the first word is the phase.
  if (const std::string_view word = phase.substr(0, phase.find(' ')); word != phase_) {
    phase_ = word;
    phase_begin_ = now;
  }
  if (now - begin_ < kQuiet || now - last_drawn_ < kInterval) return;
  const bool simulates = phase == kBsmKey || phase == kMujocoKey || phase == "both";
  write(fmt::format(
      "{}{}", kEraseLine,
      progress_line(phase, fraction, seconds(now - phase_begin_), simulates ? duration_ : 0.0)));
  last_drawn_ = now;
  drawn_ = true;
}

void ProgressBar::leave(std::string_view line) {
  clear();
  write(for_terminal(fmt::format("{}\n", line), false));
}

void ProgressBar::clear() {
  if (!drawn_) return;
  write(kEraseLine);
  drawn_ = false;
}

/// A terminal that is gone must not end the run.
void ProgressBar::write(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), terminal_);
  std::fflush(terminal_);
}

}  // namespace twincraft
