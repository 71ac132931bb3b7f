// All members of a spec: one, or those of its study, several at a time when nothing is timed.
// Tested by tests/agreement/study_test.cpp.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "runtime/study/results.h"

namespace twincraft {

/// A member's spec compiled, or why there is none.
struct MemberSpec {
  std::optional<Bundle> bundle;
  std::string refusal;
};

/// What a member leaves beside the report. Made before it is flown, destroyed with what it has not
/// published.
class MemberOutput : public MemberWatch {
 public:
  /// All samples have been taken: let go of what only a flight needs.
  virtual void land() = 0;
  /// Called for one member after another, in their order.
  virtual void publish(ReportedMember& member) = 0;
};

/// Called from several threads at once; may give nothing. The bundle outlives the flight.
using MakeOutput = std::function<std::unique_ptr<MemberOutput>(const Bundle& bundle)>;

/// A member that has been flown and has not yet been published.
struct FlownMember {
  ReportedMember member;
  std::unique_ptr<MemberOutput> output;
};

struct StudyRun {
  StudyPlan plan;
  /// Called from several threads at once.
  std::function<MemberSpec(std::size_t index)> compile;
  std::function<std::unique_ptr<MemberOutput>(std::size_t index, const Bundle& bundle)> output;
  /// Called for one member after another, in their order.
  std::function<void(std::size_t index, ReportedMember member)> finished;
  int jobs = 1;
};

/// Members come in their order whatever `jobs` is. Timed members run alone, so that no other run
/// takes their processor: `jobs` counts only when there are no trials. After a stop those that were
/// begun are finished.
void run_study(const StudyRun& study, const RunOptions& options);

/// Why the members' own specs and references let a member not be run; else what its run gave.
FlownMember run_one(MemberSpec spec, const RunOptions& options, const MakeOutput& output = {});

}  // namespace twincraft
