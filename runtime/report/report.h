// What a run of scsim has to say, before anyone decides how to print it. The printers of this room
// (json, csv, table) return text; the program writes it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/ir/bundle.h"
#include "runtime/report/provenance.h"
#include "runtime/study/attribution.h"
#include "runtime/study/run.h"
#include "runtime/study/trends.h"
#include "runtime/study/work_precision.h"

namespace twincraft {

/// A member held against another one of the same study, each engine against itself.
struct Baseline {
  struct OfEngine {
    std::string engine;  // "bsm"
    Comparison comparison;
  };
  std::size_t member = 0;
  std::vector<OfEngine> engines;  // those that ran in both
};

/// One member of a study and what made it.
struct ReportedMember {
  Bundle bundle;
  std::vector<Setting> settings;
  Member result;
  std::optional<Baseline> against = {};  // when the study compares its members

  /// Let go of what only the member's own files need: all samples but the last, and the texts.
  void shed();
};

struct Report {
  Provenance provenance;
  std::vector<ReportedMember> members;  // at least one; of a study those that were begun
  std::optional<StudyPlan> study = {};  // nothing: a single run
  // Of the one member, when it was asked for.
  std::optional<Attribution> attribution = {};

  bool complete() const;
  /// The first that some member has of interrupted, failed, unresolved (unless the study is about
  /// the step, the method or the tolerance), disagree, not judged; kAgree when none has one.
  Verdict verdict() const;
};

/// It sweeps the step, the method or the tolerance: coarse members are its subject.
bool is_about_resolution(const StudyPlan& study);

/// The members as a study looks at them; valid as long as `members` is not changed.
std::vector<StudyPoint> study_points(const std::vector<ReportedMember>& members);

/// What the members show together.
struct StudyResults {
  std::vector<Trend> convergence, scaling, slopes;
  std::vector<EngineWork> work_precision;
  std::size_t left_out = 0;  // members of no trend: unresolved or failed
};

/// Nothing of a single run; nothing of work against precision unless all its members were run.
StudyResults study_results(const Report& report);

}  // namespace twincraft
