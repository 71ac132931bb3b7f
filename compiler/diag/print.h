// Diagnostics as text for people, as JSON for programs, as SARIF for code review tools.
// Tested by tests/compiler/diag_test.cpp.
#pragma once

#include <cstddef>
#include <string>

#include "compiler/diag/diagnostics.h"

namespace twincraft {

struct PrintOptions {
  bool colour = false;
  std::size_t max_errors = 50;  // further errors are counted, not shown
};

/// `file:line:column: error[SC2041]: text`, the source line, a caret, hint and notes; last a line
/// such as `2 errors, 1 warning`. Empty without diagnostics.
std::string to_text(const Diagnostics& diagnostics, const PrintOptions& options);

/// `{"diagnostics": [...]}` as described in the interface. Without a place, `file` is empty and
/// `line`, `column`, `end_column` are null; `end_column` is one past the last marked column.
std::string to_json(const Diagnostics& diagnostics);

/// A SARIF 2.1.0 log of one run.
std::string to_sarif(const Diagnostics& diagnostics);

}  // namespace twincraft
