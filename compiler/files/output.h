// Writing results so that nothing is ever half written: every file of a run goes to a temporary
// name in its own folder and reaches the disk before the first one gets its real name. A run that
// fails leaves earlier files as they were. Also used for reports. What is meant to grow line by
// line is a GrowingFile. Tested by tests/compiler/output_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace twincraft {

/// A file that is written as its contents come, under a temporary name until it is published;
/// removed again when it is not.
class PendingFile {
 public:
  /// Folders that do not exist are made.
  explicit PendingFile(std::filesystem::path path);
  PendingFile(PendingFile&& other) noexcept;
  PendingFile& operator=(PendingFile&&) = delete;
  ~PendingFile();

  void append(std::string_view text);
  /// All of it is on the disk.
  void finish();
  /// Gives the file its name. @pre finished without an error
  /// @return empty, or why it cannot have it
  std::string publish();

  /// Empty, or what went wrong first; nothing is done after that.
  const std::string& error() const { return error_; }
  /// Where the contents are meanwhile, for libraries that write by themselves.
  const std::filesystem::path& temporary() const { return temporary_; }
  const std::filesystem::path& target() const { return target_; }

 private:
  std::string make_folder() const;
  void open();
  void close();

  std::filesystem::path target_, temporary_;
  int descriptor_ = -1;
  std::string error_;
};

/// A file that grows while a run goes on, and is of use however far it came: what append() has
/// taken stays when the program is killed. The system's own fall may lose it.
class GrowingFile {
 public:
  /// Folders that do not exist are made. One program at a time writes to it; a second one gets an
  /// error.
  /// @param keep  bytes of an earlier run that stay; what is beyond is cut off
  GrowingFile(std::filesystem::path path, std::uintmax_t keep);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  void append(std::string_view text);

  /// Empty, or what went wrong first; nothing is done after that.
  const std::string& error() const { return error_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::string error_;
};

struct OutputFile {
  std::string path;
  std::string text;
};

/// Gives finished files their names. @return as write_files
std::string publish(std::vector<PendingFile>& files);

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
