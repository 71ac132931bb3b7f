// What becomes of a run: its members, one after another, into report.json as they come; of a study
// only what the page, the table and the fits need stays in memory.
// Tested by tests/agreement/study_test.cpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/delivery/exit_code.h"
#include "runtime/delivery/member_files.h"
#include "runtime/delivery/report_files.h"

namespace twincraft {

class RunRecord {
 public:
  /// @param folder  of all files; empty: there are none
  RunRecord(Provenance provenance, std::optional<StudyPlan> study,
            const std::filesystem::path& folder);

  /// The next member. Only the first one of a study keeps its texts.
  void take(ReportedMember member);

  const Report& report() const { return report_; }
  bool empty() const { return report_.members.empty(); }
  std::size_t members() const { return taken_; }
  /// Of the members' own files.
  SharedOutput& output() { return output_; }
  const SharedOutput& output() const { return output_; }
  /// What report.json is made of; nothing without a folder.
  const ReportFiles* files() const { return files_.get(); }

  /// Everything of ours in the folder, if there is one; what an earlier run left there goes.
  /// @return empty, or what went wrong first
  std::string write(const std::function<void(double)>& progress) const;

  /// What failed, a line each, without an end; after many how many more there are.
  std::vector<std::string> failures() const;
  /// How bad the worst of that is.
  ExitCode worst() const { return worst_; }

 private:
  void note_failures(std::size_t index, const Member& member);
  void note(std::string failure, ExitCode code);

  Report report_;
  std::shared_ptr<StudyRecord> record_;  // of a study
  std::unique_ptr<ReportFiles> files_;   // nothing without a folder
  SharedOutput output_;
  std::size_t taken_ = 0;
  std::vector<std::string> failures_;  // the first of them
  std::size_t failure_count_ = 0;
  ExitCode worst_ = kExitDone;
};

}  // namespace twincraft
