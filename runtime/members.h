// All members of a spec: one, or those of its study, several at a time when nothing is timed.
// Tested by tests/agreement/study_test.cpp.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "runtime/report/report.h"

namespace twincraft {

/// A member's spec compiled, or why there is none.
struct MemberSpec {
  std::optional<Bundle> bundle;
  std::string refusal;
};

struct StudyRun {
  StudyPlan plan;
  /// Called from several threads at once.
  std::function<MemberSpec(std::size_t index)> compile;
  /// Called for one member after another, in their order, before it is shed.
  std::function<void(std::size_t index, const ReportedMember& member)> finished;
  int jobs = 1;
};

/// Members come in their order whatever `jobs` is. Timed members run alone, so that no other run
/// takes their processor: `jobs` counts only when there are no trials. After a stop those that were
/// begun are kept.
std::vector<ReportedMember> run_study(const StudyRun& study, const RunOptions& options);

/// Why the members' own specs and references let a member not be run; else what its run gave.
ReportedMember run_one(MemberSpec spec, const RunOptions& options);

}  // namespace twincraft
