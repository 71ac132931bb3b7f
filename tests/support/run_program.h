// Runs one of our programs as a user would: arguments, standard input, both outputs, exit code.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace twincraft::test {

struct ProgramResult {
  int exit_code = -1;  // 128 + signal when a signal ended it
  std::string out;
  std::string err;
};

struct ProgramInput {
  std::string standard_input;
  /// Called once the program runs, with its process id; for tests that send it a signal.
  std::function<void(pid_t)> while_running;
};

/// @param program    path of the executable
/// @throws std::runtime_error when it can not be started
ProgramResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                          const ProgramInput& input = {});

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
