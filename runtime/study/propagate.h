// One engine through one plan: fixed or adaptive steps, split at events, recorded at samples.
// A step lands on every multiple of the plan's step, every event and the end. The recorded run
// integrates the books beside the state; its trajectory is bitwise that of the bare run.
// Tested by tests/runtime/propagate_test.cpp.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "runtime/engine.h"
#include "runtime/integrate/step_control.h"

namespace twincraft {

/// What the outside did to the vehicle since t = 0, integrated beside the state.
struct Books {
  double work = 0.0;                              // [J]
  Vector3d impulse_N = Vector3d::Zero();          // [N s]
  Vector3d angular_impulse_N = Vector3d::Zero();  // [N m s] about C
  double own_work = 0.0;                          // [J] on the motion about C
};

struct Trajectory {
  enum class Status { kComplete, kInterrupted, kFailed };
  Status status = Status::kComplete;
  std::string failure;  // kFailed: what, when and which coordinate
  double t_end = 0.0;   // [s] where it got to
  // At 0, at the end, and between them at the first landing at or after each multiple of the
  // plan's `record`: when that is no multiple of the step, no step is split for it. An interrupted
  // run ends with the state it had reached, a failed one with its last good sample.
  std::vector<Observation> samples;
  std::vector<Books> books;  // one per sample
  // What was seen at the first landing at or after each of PropagateOptions::instants.
  std::vector<Observation> instants;
  // Of an adaptive method: sums of the accepted steps' estimated errors.
  AcceptedErrors accepted;
  StepCounts counts;
};

struct PropagateOptions {
  const std::atomic<bool>* stop = nullptr;    // set by a signal handler
  std::function<void(double time)> progress;  // called at most every 50 ms with the time reached
  std::vector<double> instants;               // [s] ascending: also looked at, but not recorded
};

/// With records and books: the run whose results are compared.
/// @pre step, duration and record of the plan are positive
Trajectory propagate(Engine& engine, const Model& model, const PropagateOptions& options = {});

/// The bare run that is timed: no records, no books. @throws NumericalFailure
/// @param stop  ends it early once it is set
StepCounts propagate_bare(Engine& engine, const Model& model,
                          const std::atomic<bool>* stop = nullptr);

}  // namespace twincraft
