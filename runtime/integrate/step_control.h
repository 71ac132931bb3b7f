// How an embedded pair chooses its steps. The error is judged block by block (position, velocity,
// attitude, ...), each against its own absolute + relative * |block|, and means the same for either
// engine: an attitude error is an angle, whether the state holds an MRP or a quaternion.
// Tested by tests/runtime/runge_kutta_test.cpp.
#pragma once

#include <array>
#include <atomic>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/engine/state.h"
#include "runtime/integrate/runge_kutta.h"

namespace twincraft {

/// The blocks of a state that error control looks at, in the order of the state.
enum class Block { kPosition, kVelocity, kAttitude, kRate, kJoint, kJointRate, kWheel };
inline constexpr int kBlocks = 7;
std::string_view block_name(Block block);  // as in the spec: `joint_rate`

struct StepCounts {
  long evaluations = 0;
  long accepted = 0;
  long rejected = 0;
  std::array<long, kBlocks> driven_by{};  // attempts in which this block had the largest error
};

/// What the accepted steps got wrong, by their own estimates, all added up: a bound of what the
/// tolerance let pass.
struct AcceptedErrors {
  double attitude = 0.0;      // [rad]
  std::vector<double> joint;  // [rad] or [m], one per joint
};

class StepControl {
 public:
  /// @param names  of the state's entries, for messages
  StepControl(const StateLayout& layout, const BlockTolerances& tolerance,
              std::vector<std::string> names);

  struct Verdict {
    double ratio = 0.0;  // error over tolerance of the worst block; infinite if not finite
    Block block = Block::kPosition;
    bool passes() const { return ratio <= 1.0; }
  };
  Verdict judge(std::span<const double> state, std::span<const double> error) const;

  /// Advance `stepper` from `from` to exactly `to` [s]. Starts with the whole interval; the next
  /// step is 0.9 h ratio^(-1/(order + 1)), at most 4 h and at least 0.1 h. Returns the time
  /// reached, which is `to` unless `*stop` became true. @throws NumericalFailure when the step
  /// underflows
  double advance(RungeKutta& stepper, double from, double to, StepCounts& counts,
                 const std::atomic<bool>* stop = nullptr, AcceptedErrors* accepted = nullptr) const;

 private:
  struct Range {
    Block block;
    std::size_t begin;
    std::size_t size;
    Tolerance tolerance;
  };
  double ratio(const Range& range, std::span<const double> state,
               std::span<const double> error) const;
  void add_accepted(const RungeKutta& stepper, AcceptedErrors& accepted) const;
  const Range& range_of(Block block) const { return ranges_[static_cast<std::size_t>(block)]; }
  Verdict judge_proposal(const RungeKutta& stepper) const;
  [[noreturn]] void fail(const RungeKutta& stepper, double time, const Verdict& verdict) const;

  AttitudeChart chart_;
  std::array<Range, kBlocks> ranges_;
  std::vector<std::string> names_;
};

}  // namespace twincraft
