// One engine through one plan, recorded at samples. A step lands on every multiple of the plan's
// step, every event and the end. The recorded run integrates the books beside the state; its
// trajectory is bitwise that of the bare run.
// Tested by tests/runtime/propagate_test.cpp.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "runtime/simulate/flight.h"

namespace twincraft {

/// Takes what a run records, one sample after another and a few at a time: all of them by the run's
/// end.
class SampleSink {
 public:
  virtual ~SampleSink() = default;
  virtual void take(const Observation& sample, const Books& books) = 0;
};

/// Keeps them all.
struct SampleStore : SampleSink {
  std::vector<Observation> samples;
  std::vector<Books> books;  // one per sample
  void take(const Observation& sample, const Books& now) override;
};

struct Trajectory {
  enum class Status { kComplete, kInterrupted, kFailed };
  Status status = Status::kComplete;
  std::string failure;       // kFailed: what, when and which coordinate
  double t_end = 0.0;        // [s] where it got to
  std::size_t recorded = 0;  // how many samples there were
  // At 0, at the end, and between them at the first landing at or after each multiple of the
  // plan's `record`: when that is no multiple of the step, no step is split for it. An interrupted
  // run ends with the state it had reached, a failed one with its last good sample. All of them, or
  // the last alone where a sink has taken them.
  std::vector<Observation> samples;
  std::vector<Books> books;  // one per sample
  // At the first landing at or after each of PropagateOptions::instants, as far as the run got.
  std::vector<Observation> instants;
  StepCounts counts;
  AcceptedErrors accepted;  // of an adaptive method
};

struct PropagateOptions {
  const std::atomic<bool>* stop = nullptr;         // set by a signal handler
  std::function<void(double time)> progress = {};  // at most every 50 ms: the time reached
  std::vector<double> instants = {};               // [s] sorted: see Trajectory::instants
};

/// A run with records and books that is flown in pieces. Pieces of any length give the bytes of
/// one.
class RecordedRun {
 public:
  /// Begins with the state at t = 0. All that is referred to must outlive the run.
  /// @pre step, duration and record of the plan are positive
  RecordedRun(Engine& engine, const Model& model, SampleSink& sink, PropagateOptions options = {});
  ~RecordedRun();
  RecordedRun(const RecordedRun&) = delete;
  RecordedRun& operator=(const RecordedRun&) = delete;

  /// On to the first landing at or after `time` [s]; less far when the run ends before.
  void advance_until(double time);

  bool ended() const;  // at its duration, stopped or failed
  double time() const;

  /// How it went so far, with the last sample alone. The run has nothing left to tell then.
  Trajectory take_trajectory();

 private:
  class Recording;
  std::unique_ptr<Recording> recording_;
};

/// The whole run at once, with all its samples: the run whose results are compared.
/// @pre as RecordedRun
Trajectory propagate(Engine& engine, const Model& model, const PropagateOptions& options = {});

/// The bare run that is timed: no records, no books. @throws NumericalFailure
/// @param stop  ends it early once it is set
StepCounts propagate_bare(Engine& engine, const Model& model,
                          const std::atomic<bool>* stop = nullptr);

}  // namespace twincraft
