// report.json and report.html. Members go to the disk as they come, since there may be a million of
// them; what stands before them in the file is known at the end.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "compiler/files/output.h"
#include "runtime/delivery/output_folder.h"
#include "runtime/study/results.h"

namespace twincraft {

class ReportFiles {
 public:
  /// @param folder  where members are until they are written
  explicit ReportFiles(const std::filesystem::path& folder);

  /// The next member, with all that it holds.
  void add(const ReportedMember& member);

  /// Both files, of all members that were added, into `folder`.
  /// @param progress  called now and then with how much is done, 0 to 1 @return as write_files
  std::string write(const Report& report, const std::filesystem::path& folder,
                    const std::function<void(double)>& progress = {}) const;

  /// The bytes of report.json. @throws std::runtime_error when the members cannot be read again
  std::string json(const Report& report) const;

 private:
  using Take = std::function<void(std::string_view part)>;
  std::string put_json(const Report& report, const Take& take,
                       const std::function<void(double)>& progress) const;

  PendingFile members_;   // never published
  std::size_t size_ = 0;  // [bytes] of all members
};

/// Why nothing can be written into a folder without a name: it is not the current one.
inline constexpr const char* kNoFolder = "no folder is named: its name is empty";

/// What they are called in a folder; nothing in none.
std::vector<std::string> report_paths(const std::string& folder);

/// Both files of a report that has all its members; what an earlier run left in the folder goes.
/// @return as write_files
std::string write_report(const Report& report, const OutputFolder& folder);

}  // namespace twincraft
