// Runs one of our programs as a user would: arguments, standard input, both outputs, exit code. No
// shell stands between, and nothing sleeps: what is waited for announces itself.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace twincraft::test {

struct ProgramResult {
  int exit_code = -1;  // 128 + signal when a signal ended it
  std::string out;
  std::string err;
};

struct ProgramInput {
  std::string standard_input = {};
  /// Called while the program runs, with its process id; for tests that send it a signal.
  std::function<void(pid_t)> while_running = {};
  /// What the program has written to standard error before that, a regular expression; empty:
  /// nothing need be.
  std::string awaited = {};
  std::filesystem::path folder = {};     // where it runs; empty: here
  std::optional<std::size_t> data = {};  // most memory for data [bytes]; absent: no limit
  /// Where standard output goes instead of into the result.
  enum class Output { kKept, kClosed, kFullDevice } output = Output::kKept;
};

/// A program that is sent `signal` once it has written `awaited` to standard error. It says that it
/// has got so far, so the machine may be as slow as it likes.
ProgramInput signalled_after(const std::string& awaited, int signal);

/// Returns once `program` has had so much processor time [s], or has ended. The kernel counts it
/// and tells.
void await_work(pid_t program, double seconds);

/// @param program    path of the executable
/// @throws std::runtime_error when it can not be started, ends without writing what is awaited, or
///         is silent for minutes before it does
ProgramResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                          const ProgramInput& input = {});

/// The bytes of a file; empty when there is none.
std::string read_file(const std::filesystem::path& path);

/// A folder of its own that is removed again with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::string& path() const { return path_; }
  /// Write a file in it. @return its path
  std::string write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  bool has(const std::string& name) const;

 private:
  std::string path_;
};

}  // namespace twincraft::test
