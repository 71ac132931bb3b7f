// What a command line of ours is beyond CLI11: usage errors with the near miss, the exit codes,
// what becomes of warnings, and when to use colour.  Tested by tests/agreement/scsim_test.cpp.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compiler/diag/diagnostics.h"
#include "compiler/diag/terminal.h"

namespace twincraft {

enum ExitCode {
  kExitDone = 0,
  kExitFindings = 1,
  kExitUsage = 2,
  kExitInputOutput = 3,
  kExitFailure = 4,
};

/// Parse into `app`. Prints help or version to standard output, a usage error with its near miss to
/// standard error. A flag with an empty value is a usage error. @return nothing to go on, or the
/// code the program exits with
std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv);

/// A usage error on standard error. @return kExitUsage
int report_usage(std::string_view program, const std::string& text, const std::string& hint);

/// What `--explain` prints for a code, such as `SC2007`; in lower case it is known too.
/// @return the exit code
int explain_code(std::string_view program, const std::string& word);

/// Accepts exactly these words; for any other it names the nearest.
CLI::Validator one_of(std::vector<std::string> words);

/// The flag `-W`, into `words`: `-Werror`, `-Wno-SC3402`.
void add_warning_flags(CLI::App& app, std::vector<std::string>& words);
/// Does to `diagnostics` what the words ask for.
void judge_warnings(const std::vector<std::string>& words, Diagnostics& diagnostics);

/// Runs a program's body, and says on standard error what ended it early.
/// @return the exit code: that of `body`, or kExitFailure after an exception
int run_program(std::string_view program, const std::function<int()>& body);

}  // namespace twincraft
