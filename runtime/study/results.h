// What a run has to say, before anyone decides how to print it.
// Tested by tests/runtime/report_test.cpp.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compiler/ir/bundle.h"
#include "runtime/study/attribution.h"
#include "runtime/study/member.h"
#include "runtime/study/provenance.h"
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
  std::vector<OfEngine> engines;         // those that ran in both, and failed in neither
  std::vector<std::string> failed = {};  // engines that failed in the baseline
};

/// A number that a study asks of a member's flight, see OutputPlan; SI.
struct OutputValue {
  std::string name, unit;
  std::optional<double> value;         // nothing: never reached
  std::optional<double> below, above;  // what is required of it
  bool holds = true;
};

class PageSeries;  // runtime/report/page/page_series.h: of no meaning here

/// One member of a study and what made it.
struct ReportedMember {
  Bundle bundle;
  std::vector<Setting> settings;
  Member result;
  std::optional<Baseline> against = {};   // when the study compares its members
  std::vector<OutputValue> outputs = {};  // that the study asks for, of the analytic engine
  // What the page draws of the samples; nothing: it is made of those that were kept.
  std::shared_ptr<const PageSeries> series = {};

  /// Let go of what only the member's own files and report.json need: all samples but the last, and
  /// the texts.
  void shed();
};

/// What a study keeps of its members, so that it need not keep them.
class StudyRecord {
 public:
  /// @param keep_ends  whether work is to be held against precision
  explicit StudyRecord(bool keep_ends) : keep_ends_(keep_ends) {}

  void add(const ReportedMember& member);

  std::size_t members() const { return points_.all().size(); }
  std::size_t complete() const { return complete_; }
  std::size_t count(Verdict verdict) const;
  /// Of the first member that has some.
  const std::vector<JudgedFigure>& exceeded() const { return exceeded_; }
  bool is_judged() const { return is_judged_; }                      // something had a tolerance
  bool judges_agreement() const { return judges_agreement_; }        // of every member
  bool breaks_requirements() const { return breaks_requirements_; }  // some member does
  const StudyPoints& points() const { return points_; }

 private:
  bool keep_ends_;
  std::size_t complete_ = 0;
  std::map<Verdict, std::size_t> verdicts_;
  std::vector<JudgedFigure> exceeded_;
  bool is_judged_ = false, judges_agreement_ = true, breaks_requirements_ = false;
  StudyPoints points_;
};

/// So many members of a study are kept for the page and the table; report.json has them all.
inline constexpr std::size_t kKeptMembers = 500;

struct Report {
  Provenance provenance;
  // At least one; of a study the first kKeptMembers of those that were begun.
  std::vector<ReportedMember> members;
  std::optional<StudyPlan> study = {};  // nothing: a single run
  // Of the one member, when it was asked for.
  std::optional<Attribution> attribution = {};
  // Of all members of a study; nothing: `members` are all.
  std::shared_ptr<const StudyRecord> record = {};

  /// Of all members.
  std::shared_ptr<const StudyRecord> summary() const;
  bool complete() const;
  /// The first that some member has of interrupted, failed, unresolved (unless the study is about
  /// the step, the method or the tolerance), disagree, not judged; kAgree when none has one.
  Verdict verdict() const;
};

/// It sweeps the step, the method or the tolerance: coarse members are its subject.
bool is_about_resolution(const StudyPlan& study);

/// The members as a study looks at them.
StudyPoints study_points(const std::vector<ReportedMember>& members);

/// What the members show together.
struct StudyResults {
  std::vector<Trend> convergence, scaling, slopes;
  std::vector<EngineWork> work_precision;
  std::size_t left_out = 0;  // members of no trend: unresolved or failed
};

/// Nothing of a single run; nothing of work against precision unless all its members were run.
StudyResults study_results(const Report& report);

}  // namespace twincraft
