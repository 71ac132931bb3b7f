// The compiler from text to bundle: load, read, check, lower, verify, emit. The file to read first.
// Tested by tests/compiler/pipeline_test.cpp, tests/golden and tests/malformed.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "compiler/diag/diagnostics.h"
#include "compiler/ir/bundle.h"

namespace twincraft {

/// What to compile: a spec's text and what the command line changes in it.
struct CompileRequest {
  std::string file;                    // as given; `-` is standard input
  std::vector<std::string> overrides;  // `PATH=VALUE`
};

struct CompileResult {
  std::optional<Bundle> bundle;  // nothing when there were errors
  std::string io_error;          // the file could not be read: exit code 3
};

/// The compiler contradicts itself: a bug of ours, with a text that asks to report it.
struct InternalError : std::logic_error {
  using std::logic_error::logic_error;
};

/// All faults of a stage are reported; a later stage runs only after an earlier one without errors.
/// @throws InternalError when the two halves of the model are not one machine
CompileResult compile(const CompileRequest& request, Sources& sources, Diagnostics& diagnostics);

/// The JSON Schema of the language (draft-07), as checked in under schemas/.
std::string json_schema();
/// The reference text generated from the field tables (Markdown).
std::string reference_markdown();

/// SHA-256 of `text`, 64 lower-case hexadecimal digits.
std::string sha256(const std::string& text);

}  // namespace twincraft
