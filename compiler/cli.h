// What a command line of ours is beyond CLI11: usage errors with the near miss, the exit codes, and
// when to use colour.  Tested by tests/agreement/scsim_test.cpp.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace twincraft {

enum ExitCode {
  kExitDone = 0,
  kExitFindings = 1,
  kExitUsage = 2,
  kExitInputOutput = 3,
  kExitFailure = 4,
};

/// Parse into `app`. Prints help or version to standard output, a usage error with its near miss to
/// standard error. @return nothing to go on, or the code the program exits with
std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv);

/// Accepts exactly these words; for any other it names the nearest.
CLI::Validator one_of(std::vector<std::string> words);

/// `file` is a terminal that wants colour: NO_COLOR is respected, and TERM=dumb.
bool wants_colour(int file_descriptor);

}  // namespace twincraft
