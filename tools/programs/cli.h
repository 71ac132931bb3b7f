// What our programs share beyond their flags: exit codes, usage errors, what becomes of warnings.
// Tested by tests/agreement/scsim_test.cpp.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diag/diagnostics.h"
#include "compiler/diag/terminal.h"
#include "runtime/delivery/exit_code.h"
#include "tools/programs/command_line.h"

namespace twincraft {

/// A usage error on standard error. @return kExitUsage
int report_usage(std::string_view program, const std::string& text, const std::string& hint);

/// What `--explain` prints for a code, such as `SC2007`; in lower case it is known too.
/// @return the exit code
int explain_code(std::string_view program, const std::string& word);

/// Without blanks at either end.
std::string trimmed(std::string_view text);

/// The flag `-W`, into `words`: `-Werror`, `-Wno-SC3402`.
void add_warning_flags(CommandLine& line, std::vector<std::string>& words);
/// Does to `diagnostics` what the words ask for.
void judge_warnings(const std::vector<std::string>& words, Diagnostics& diagnostics);

/// Runs a program's body, and says on standard error what ended it early.
/// @return the exit code: that of `body`, or kExitFailure after an exception
int run_program(std::string_view program, const std::function<int()>& body);

}  // namespace twincraft
