// Small looks at YAML text around a place that yaml-cpp marked. Offsets are bytes of `text`.
// Tested by tests/compiler/load_test.cpp.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace twincraft {

/// The byte at `at`, NUL after the end.
char char_at(std::string_view text, std::size_t at);

/// The first byte from `at` on that is neither blank nor tab.
std::size_t skip_blanks(std::string_view text, std::size_t at);

/// The end of the run of bytes from `at` on that are no white space, bracket or comma.
std::size_t end_of_word(std::string_view text, std::size_t at);

/// The last byte before `at` that is no white space; `at` when there is none.
std::size_t last_visible(std::string_view text, std::size_t at);

/// Bytes from `begin` to `end` that lie on the line of `begin`; at least 1.
std::size_t length_on_line(std::string_view text, std::size_t begin, std::size_t end);

/// The quote that closes the one at `open`; none when the text ends first.
std::optional<std::size_t> find_closing_quote(std::string_view text, std::size_t open);

/// The end of an unquoted or block (`|`, `>`) scalar at `at` whose folded value is `value`.
std::size_t end_of_plain(std::string_view text, std::size_t at, std::string_view value);

/// Length of `null` in one of YAML's spellings at `at`; 0 when it is not there.
std::size_t length_of_null(std::string_view text, std::size_t at);

/// Whether `at` is a `---` or the first content after a `...`.
bool begins_document(std::string_view text, std::size_t at);

/// The first line from `begin` up to `end` that begins with `%`.
std::optional<std::size_t> find_directive(std::string_view text, std::size_t begin,
                                          std::size_t end);

}  // namespace twincraft
