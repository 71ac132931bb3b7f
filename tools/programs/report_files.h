// report.json and report.html. Members go to the disk as they come, since there may be a million of
// them; what stands before them in the file is known at the end.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include "compiler/files/output.h"
#include "runtime/study/results.h"

namespace twincraft {

class ReportFiles {
 public:
  explicit ReportFiles(std::filesystem::path folder);

  /// The next member, with all that it holds.
  void add(const ReportedMember& member);

  /// Both files, of all members that were added.
  /// @param progress  called now and then with how much is done, 0 to 1 @return as write_files
  std::string write(const Report& report, const std::function<void(double)>& progress = {});

 private:
  std::string copy_members(PendingFile& to, const std::function<void(double)>& progress);

  std::filesystem::path folder_;
  PendingFile members_;   // never published
  std::size_t size_ = 0;  // [bytes] of all members
};

}  // namespace twincraft
