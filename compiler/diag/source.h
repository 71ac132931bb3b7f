// Texts the user wrote and places in them. Every diagnostic points into a Source; every syntax
// node knows its Span. Tested by tests/compiler/diag_test.cpp.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace twincraft {

class Source;

/// A place in a source, 1-based; columns count bytes. An empty span (no source) is a fault without
/// a place, such as a bad command line.
struct Span {
  const Source* source = nullptr;
  int line = 0;
  int column = 0;
  int length = 0;

  bool operator==(const Span&) const = default;
};

/// One text: a spec file, standard input, or the value of a `--set`.
class Source {
 public:
  /// @param name  what diagnostics call it: the path as given, `<stdin>`, or `--set PATH`
  /// @param text  a leading byte order mark is dropped, so that columns are those of an editor
  Source(std::string name, std::string text);

  const std::string& name() const { return name_; }
  const std::string& text() const { return text_; }
  /// Line `number` (1-based) without its line end; empty when there is no such line.
  std::string_view line(int number) const;
  /// The place of the `length` bytes of `text()` from `begin` on, which lie on one line.
  Span span(std::size_t begin, std::size_t length) const;

 private:
  std::string name_;
  std::string text_;
  std::vector<std::size_t> line_starts_;
};

/// Owns the sources of a run; a reference stays valid as long as its owner lives.
class Sources {
 public:
  const Source& add(std::string name, std::string text);

 private:
  std::deque<Source> sources_;
};

}  // namespace twincraft
