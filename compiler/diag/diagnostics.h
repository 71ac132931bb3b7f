// What is wrong with the user's text, as data. Stages report here and go on; the program prints all
// of it at the end, sorted by place. Users' mistakes never travel as exceptions.
// Tested by tests/compiler/diag_test.cpp.
#pragma once

#include <cstddef>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compiler/diag/source.h"

namespace twincraft {

enum class Severity { kError, kWarning, kNote };

/// `error`, `warning`, `note`
std::string_view severity_name(Severity severity);

/// Every kind of fault there is; codes.def is the only registry.
enum class Code {
#define TWINCRAFT_CODE(identifier, number, title, explanation) identifier,
#include "compiler/diag/codes.def"
#undef TWINCRAFT_CODE
};

/// `SC2041`
std::string_view code_name(Code code);
/// One line: what kind of fault this is.
std::string_view code_title(Code code);
/// The long text of `sccompile --explain`.
std::string_view code_explanation(Code code);
/// All codes in the order of the registry.
const std::vector<Code>& all_codes();

/// Another place that explains the fault ("first defined here").
struct Note {
  Span span;
  std::string message;

  bool operator==(const Note&) const = default;
};

struct Diagnostic {
  Severity severity = Severity::kError;
  Code code{};
  Span span;
  std::string message;  // lower case, no full stop, user text in backticks
  std::string hint;     // empty: none
  std::vector<Note> notes;

  bool operator==(const Diagnostic&) const = default;

  Diagnostic& with_hint(std::string text) {
    hint = std::move(text);
    return *this;
  }
  Diagnostic& with_note(Span where, std::string text) {
    notes.push_back({where, std::move(text)});
    return *this;
  }
};

class Diagnostics {
 public:
  /// Add a fault; the reference is valid until the next one is added. Of a file with more errors
  /// than anybody reads the first 10 000 are kept and the others counted.
  Diagnostic& error(Code code, Span span, std::string message);
  Diagnostic& warning(Code code, Span span, std::string message);
  Diagnostic& note(Code code, Span span, std::string message);
  /// One that was made elsewhere.
  void take(Diagnostic diagnostic);

  /// Spans of these diagnostics may point into `texts`, which live as long as they do.
  void keep(std::shared_ptr<const Sources> texts);

  /// What `-Wno-CODE` does: warnings and notes of these codes are forgotten. Errors stay.
  void silence(const std::vector<Code>& codes);
  /// What `-Werror` does: every warning becomes an error.
  void promote_warnings();

  bool has_errors() const { return error_count() > 0; }
  std::size_t error_count() const;
  /// Errors that were counted and not kept.
  std::size_t dropped() const { return dropped_; }
  const std::vector<Diagnostic>& all() const { return all_; }
  /// By source in order of first mention, then line and column; exact repeats removed.
  std::vector<Diagnostic> sorted() const;

 private:
  Diagnostic& add(Diagnostic diagnostic);

  std::vector<Diagnostic> all_;
  std::size_t dropped_ = 0;
  Diagnostic last_dropped_;
  std::set<std::shared_ptr<const Sources>> texts_;
};

/// The entry of `candidates` nearest to `word` by edit distance, or empty when none is near enough
/// to be a likely slip.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// `text` with control characters, invalid UTF-8 and characters that reorder text shown as escapes:
/// safe on a terminal.
std::string printable(std::string_view text);

/// The user's text in backticks for a message, printable, and cut when it is long.
std::string in_backticks(std::string_view text);

}  // namespace twincraft
