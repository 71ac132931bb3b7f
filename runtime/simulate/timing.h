// What a run costs, by the paper's protocol: each engine built and initialised outside the clock,
// one discarded warm-up, N trials of the bare run, engines interleaved with their order reversed on
// alternate rounds, the median of a monotonic clock.
// Tested by tests/runtime/timing_test.cpp.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/engine/engine.h"

namespace twincraft {

/// One contestant: what is built once and then run again and again.
struct TimedEngine {
  std::string name;                  // "bsm"
  std::function<std::size_t()> run;  // one bare run; @return how many steps it took, 0 if stopped
};

struct EngineTiming {
  std::string name;
  std::vector<double> trials;  // [s]
  std::size_t steps = 0;       // of one trial

  double median() const;    // [s] @pre trials is not empty
  double per_step() const;  // [s] median over steps
  double spread() const;    // half of the trials are within this part of the median
};

/// A larger spread says more of what else the machine did than of the engine.
inline constexpr double kScattered = 0.5;

struct Timing {
  int planned_trials = 0;
  std::vector<EngineTiming> engines;  // in the order given

  /// Every engine has all its trials.
  bool complete() const;

  /// Median of the first engine over that of the second (BSM over MuJoCo); nothing unless there are
  /// two, each with all its trials, and these are not scattered.
  std::optional<double> ratio() const;
};

/// Asked before every run, outside the clock, with the number of runs done and planned (warm-ups
/// included); false ends the timing.
using MayGoOn = std::function<bool(int done, int planned)>;

/// Seconds since any fixed moment; it never goes back.
using Stopwatch = std::function<double()>;

/// The machine's monotonic clock.
double monotonic_seconds();

/// Warm up, then time. Ended early, an engine has fewer trials than planned, or none. What an
/// engine throws passes through.
/// @param stopwatch  read before and after each trial and at no other time
Timing time_engines(const std::vector<TimedEngine>& engines, int trials, const MayGoOn& may_go_on,
                    const Stopwatch& stopwatch = monotonic_seconds);

/// The contestant that propagates `model` without records or books.
/// @param stop  ends a run once it is set; what it took then is no trial
TimedEngine bare_run(std::shared_ptr<Engine> engine, const Model& model,
                     const std::atomic<bool>* stop = nullptr);

/// `warmup=1 trials=5 interleaved reversed`
std::string protocol(const Timing& timing);

/// Median of a non-empty sample; the mean of the middle two when their number is even.
double median(std::vector<double> values);

}  // namespace twincraft
