// The compiler from text to bundle: load, read, check, lower, verify, emit. The file to read first.
// Tested by tests/compiler/pipeline_test.cpp, tests/golden and tests/malformed.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "compiler/diag/diagnostics.h"
#include "compiler/ir/bundle.h"

namespace twincraft {

/// What to compile: a spec's text and what the command line changes in it.
struct CompileRequest {
  std::string file;                      // as given; `-` is standard input
  std::vector<std::string> overrides;    // `PATH=VALUE`
  std::optional<std::string> text = {};  // of the spec, when it is no file; `file` is its name then
  // Called before each member of a study that is checked: how many are done, and of how many.
  std::function<void(std::size_t done, std::size_t planned)> progress = {};
};

/// The members of a study, each compiled when it is asked for; none is kept. Lives no longer than
/// the Sources it was read from.
class Study {
 public:
  virtual ~Study() = default;
  virtual const StudyPlan& plan() const = 0;

  /// Nothing when the member's spec has errors. Any number of threads may call it at once, each
  /// with diagnostics of its own. @throws InternalError as compile() does
  virtual std::optional<Bundle> compile(std::size_t index, Diagnostics& diagnostics) const = 0;
};

/// The spec itself with further changes, without its study; compiled when asked for, none kept.
/// Lives no longer than the Sources it was read from.
class Variants {
 public:
  virtual ~Variants() = default;

  /// @param overrides  `PATH=VALUE`, after those of the command line
  /// Nothing when the changed spec has errors. Any number of threads may call it at once, each with
  /// diagnostics of its own. @throws InternalError as compile() does
  virtual std::optional<Bundle> compile(const std::vector<std::string>& overrides,
                                        Diagnostics& diagnostics) const = 0;
};

/// So many members of a study are checked by compile(), fewer of a large spec; a larger study gets
/// a note that says so.
inline constexpr std::size_t kCheckedMembers = 10'000;

struct CompileResult {
  std::optional<Bundle> bundle = {};        // of the spec itself; nothing when there were errors
  std::string io_error = {};                // the file could not be read: exit code 3
  bool bad_override = false;                // an override is no PATH=VALUE: exit code 2
  std::unique_ptr<const Study> study = {};  // when the spec has one
  std::unique_ptr<const Variants> variants = {};  // with the bundle
  Span step = {};                                 // where the spec gives the step, with the bundle
  Span record_span = {};  // where `simulation.record` is written, or what stands for it
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
