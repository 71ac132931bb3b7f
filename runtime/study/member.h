// One member of a study, from a compiled bundle to everything there is to report: both engines
// propagated, checked against the books, compared, held against references, timed. The file to read
// first in this room.  Tested by tests/agreement/scsim_test.cpp.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/ir/bundle.h"
#include "runtime/bsm/processor.h"
#include "runtime/compare/agreement.h"
#include "runtime/compare/conservation.h"
#include "runtime/compare/verdict.h"
#include "runtime/linear/resolution.h"
#include "runtime/reference/reference.h"
#include "runtime/simulate/timing.h"

namespace twincraft {

struct RunOptions {
  bool bsm = true;
  bool mujoco = true;
  int trials = 5;  // 0: no timing
  // All samples stay in the trajectories; otherwise the last alone, and memory does not grow with
  // their number.
  bool keep_samples = true;
  const std::atomic<bool>* stop = nullptr;  // set by a signal handler
  bool side_by_side = false;                // the engines on a thread each; the same results
  bsm::Choice instructions = bsm::choose(bsm::Use::kOne);  // of the analytic engine
  /// Called now and then: what is being done, and how much of it, 0 to 1.
  std::function<void(std::string_view phase, double fraction)> progress;

  bool stopped() const { return stop != nullptr && *stop; }
  void show(std::string_view phase, double fraction) const {
    if (progress) progress(phase, fraction);
  }
};

struct EngineRun {
  enum class Status { kOk, kSkipped, kFailed };
  std::string name;  // "bsm", "mujoco"
  Status status = Status::kOk;
  std::string reason;     // skipped, failed or interrupted: why
  Trajectory trajectory;  // no samples when skipped; see RunOptions::keep_samples
  Conservation conservation;
  EnergyFigures own_energy;
};

/// One engine against one truth.
struct ReferenceRun {
  std::string name;    // "kepler"
  std::string engine;  // "bsm"
  std::vector<Deviation> deviations;
};

struct Member {
  std::vector<EngineRun> engines;        // always bsm, mujoco
  std::optional<Comparison> comparison;  // when both ran
  std::vector<Balance> conservation;     // of what ran: energy, momentum, angular momentum
  std::vector<ReferenceRun> references;
  std::optional<Timing> timing;          // when asked for and the runs succeeded
  std::optional<Resolution> resolution;  // when an engine flew
  bool judges_resolution = true;         // what the spec asks for
  bool complete = false;                 // everything asked for was computed to its end
  bool refused = false;                  // nothing was run: the engines say why

  /// Every figure that has a tolerance: agreement, conservation, references, in this order.
  std::vector<JudgedFigure> judged() const;
  std::vector<JudgedFigure> exceeded() const;  // those that did not hold
  bool judges_agreement() const;               // one of them is of agreement
  /// The first that holds of failed, interrupted, unresolved, disagree, agree, not judged.
  Verdict verdict() const;
  bool failed() const;       // an engine failed numerically
  bool interrupted() const;  // a signal came before all was done
  bool unresolved() const;   // and that is judged
};

/// A member that cannot be run, for a reason other than numbers: both engines skip it.
Member refused_member(const std::string& reason);

/// Sees the samples of a member as they are recorded.
class MemberWatch {
 public:
  virtual ~MemberWatch() = default;
  /// The next sample of engine 0 (bsm) or 1 (mujoco); those of the other may come at the same time,
  /// from another thread.
  virtual void take(std::size_t engine, const Observation& sample, const Books& books) = 0;
  /// Both engines at the same instant, when neither is in take(), and every metric there, in the
  /// order of metric_laws() and in the unit its key ends in.
  virtual void take_pair(const Observation& bsm, const Observation& mujoco,
                         std::span<const double> metrics) = 0;
};

/// Numerical failures are part of the result.
Member run_member(const Bundle& bundle, const RunOptions& options, MemberWatch* watch = nullptr);

}  // namespace twincraft
