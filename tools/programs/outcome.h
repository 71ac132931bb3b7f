// What becomes of a run: its members, one after another, into report.json as they come; of a study
// only what the page, the table and the fits need stays in memory.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/programs/command.h"
#include "tools/programs/member_files.h"
#include "tools/programs/report_files.h"

namespace twincraft {

class Outcome {
 public:
  Outcome(const CommonOptions& options, std::optional<StudyPlan> study);

  /// The next member. Only the first one of a study keeps its texts.
  void take(ReportedMember member);

  const Report& report() const { return report_; }
  bool empty() const { return report_.members.empty(); }
  std::size_t members() const { return taken_; }
  /// Of the members' own files.
  SharedOutput& output() { return output_; }

  /// report.json and report.html, if there are to be any; what an earlier run left in the folder
  /// goes. @return the exit code
  int write(const std::function<void(double)>& progress);
  /// Says what failed. @return how bad the worst member is
  int complain_of_failures() const;

 private:
  void note_failures(std::size_t index, const Member& member);
  void note(std::string failure, int code);

  Report report_;
  std::shared_ptr<StudyRecord> record_;  // of a study
  std::unique_ptr<ReportFiles> files_;   // nothing without -o
  SharedOutput output_;
  std::size_t taken_ = 0;
  std::vector<std::string> failures_;  // the first of them
  std::size_t failure_count_ = 0;
  int worst_ = kExitDone;
};

}  // namespace twincraft
