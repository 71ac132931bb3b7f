// See outcome.h. Tested by tests/agreement/study_test.cpp.
#include "tools/programs/outcome.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace twincraft {
namespace {

constexpr std::size_t kMostFailures = 100;  // that are told one by one

}  // namespace

Outcome::Outcome(const CommonOptions& options, std::optional<StudyPlan> study)
    : report_{provenance_of(options), {}, std::move(study)}, output_{OutputFolder(options.folder)} {
  if (!options.folder.empty()) files_ = std::make_unique<ReportFiles>(options.folder);
  if (!report_.study) return;
  record_ = std::make_shared<StudyRecord>(report_.study->is_work_precision);
  report_.record = record_;
}

void Outcome::take(ReportedMember member) {
  if (files_) files_->add(member);
  if (record_) record_->add(member);
  note_failures(taken_, member.result);
  const bool is_first = taken_++ == 0;
  if (!is_first) member.shed();
  if (report_.members.size() < kKeptMembers) report_.members.push_back(std::move(member));
}

void Outcome::note(std::string failure, int code) {
  if (failure_count_++ < kMostFailures) failures_.push_back(std::move(failure));
  worst_ = std::max(worst_, code);
}

void Outcome::note_failures(std::size_t index, const Member& member) {
  const std::optional<StudyPlan>& study = report_.study;
  const std::string which = study ? fmt::format("member {}: ", index) : "";
  if (member.refused)
    note(fmt::format("{}error: {}", which, member.engines[0].reason), kExitFindings);
  // What diverges in a work-precision study is a result, but not its reference or check.
  if (study && study->is_work_precision && index + 2 < study->members) return;
  for (const EngineRun& run : member.engines)
    if (run.status == EngineRun::Status::kFailed)
      note(fmt::format("{}{} failed: {}", which, run.name, run.reason), kExitFailure);
}

int Outcome::complain_of_failures() const {
  for (const std::string& failure : failures_) complain(failure);
  if (failure_count_ > failures_.size())
    complain(
        fmt::format("... and {} more failures, in report.json", failure_count_ - failures_.size()));
  return worst_;
}

int Outcome::write(const std::function<void(double)>& progress) {
  if (!files_) return kExitDone;
  const std::string error =
      output_.error.empty() ? files_->write(report_, progress) : output_.error;
  if (error.empty()) {
    output_.folder.remove_leftovers();
    return kExitDone;
  }
  complain(error);
  return kExitInputOutput;
}

}  // namespace twincraft
