// Writing results so that nothing is ever half written: every file of a run goes to a temporary
// name in its own folder and reaches the disk before the first one gets its real name. A run that
// fails leaves earlier files as they were. Also used for reports.
// Tested by tests/compiler/output_test.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace twincraft {

struct OutputFile {
  std::string path;
  std::string text;
};

/// Write all of them or none; folders that do not exist are made.
/// @return empty, or what went wrong: "cannot write `out/a.xml`: no space left on device"
std::string write_files(const std::vector<OutputFile>& files);

/// Whether files of these names could be written, tried now because a run may take hours; folders
/// that do not exist are made. @return as write_files
std::string try_files(const std::vector<std::string>& paths);

/// Text for people, by way of `for_terminal`.
/// @return empty, or what went wrong (a closed pipe included, when SIGPIPE is ignored)
std::string write_standard_output(std::string_view text);

/// The bytes of a result, such as `NAME.xml` of `-o -`; on a terminal they are text for people.
/// @return as write_standard_output
std::string write_document(std::string_view bytes);

/// Text for people, by way of `for_terminal`; as much of it as the system takes: there is nobody
/// left to tell of a failure.
void write_standard_error(std::string_view text);

/// From now on a closed pipe and a file beyond the size limit are errors of write(), with a
/// message, and no longer the end of the process.
void survive_failed_writes();

}  // namespace twincraft
