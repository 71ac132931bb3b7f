// See run_record.h.
#include "runtime/delivery/run_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace twincraft {
namespace {

constexpr std::size_t kMostFailures = 100;  // that are told one by one

}  // namespace

RunRecord::RunRecord(Provenance provenance, std::optional<StudyPlan> study,
                     const std::filesystem::path& folder)
    : report_{std::move(provenance), {}, std::move(study)}, output_{OutputFolder(folder)} {
  if (!folder.empty()) files_ = std::make_unique<ReportFiles>(folder);
  if (!report_.study) return;
  record_ = std::make_shared<StudyRecord>(report_.study->is_work_precision);
  report_.record = record_;
}

void RunRecord::take(ReportedMember member) {
  if (files_) files_->add(member);
  if (record_) record_->add(member);
  note_failures(taken_, member.result);
  const bool is_first = taken_++ == 0;
  if (!is_first) member.shed();
  if (report_.members.size() < kKeptMembers) report_.members.push_back(std::move(member));
}

void RunRecord::note(std::string failure, ExitCode code) {
  if (failure_count_++ < kMostFailures) failures_.push_back(std::move(failure));
  worst_ = std::max(worst_, code);
}

void RunRecord::note_failures(std::size_t index, const Member& member) {
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

std::vector<std::string> RunRecord::failures() const {
  std::vector<std::string> lines = failures_;
  if (failure_count_ > failures_.size())
    lines.push_back(
        fmt::format("... and {} more failures, in report.json", failure_count_ - failures_.size()));
  return lines;
}

std::string RunRecord::write(const std::function<void(double)>& progress) const {
  if (!files_ || empty()) return {};
  if (!output_.error.empty()) return output_.error;
  std::string error = files_->write(report_, output_.folder.of_member(0), progress);
  if (error.empty()) output_.folder.remove_leftovers();
  return error;
}

}  // namespace twincraft
