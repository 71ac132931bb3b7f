// yaml-cpp's events to our nodes, refusing on the way what YAML allows and specs do without.
// Tested by tests/compiler/load_test.cpp.
#pragma once

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/mark.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "compiler/diag/diagnostics.h"
#include "compiler/syntax/node.h"

namespace twincraft {

/// Thrown by the builder to leave yaml-cpp, which knows no other way to end early. Whoever throws
/// it has reported why.
struct StopParsing {};

class TreeBuilder : public YAML::EventHandler {
 public:
  /// @param begin  offset in the source's text at which the parsed part begins
  TreeBuilder(const Source& source, std::size_t begin, Diagnostics& diagnostics);

  /// The finished document; none when there was none.
  std::optional<Node> take_root() { return std::move(root_); }

  /// Offset in the source's text of a mark of yaml-cpp.
  std::size_t offset_of(const YAML::Mark& mark) const;
  /// Offset of the `[` or `{` of the innermost list or map in brackets that is still open.
  std::optional<std::size_t> innermost_bracket() const;
  /// Offset just after the last scalar; what follows up to the next is punctuation and comments.
  std::size_t end_of_last_scalar() const { return scalar_end_; }

  void OnDocumentStart(const YAML::Mark& mark) override;
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override;
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override;
  void OnSequenceEnd() override;
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override;
  void OnMapEnd() override;
  void OnAnchor(const YAML::Mark& mark, const std::string& name) override;

 private:
  /// A list or map that is being filled.
  struct Frame {
    Node node;
    std::size_t offset = 0;
    bool in_brackets = false;
    bool has_key = false;     // map: the next node is the value
    bool keeps_value = true;  // false after a key that was refused
    Node::Key key;
    std::unordered_map<std::string, Span> seen;
  };

  /// `[a: 1]` holds a map that has no brackets of its own.
  bool is_implicit_pair(const Frame& frame) const;
  bool expects_key() const;
  void open(Node::Kind kind, const YAML::Mark& mark, const std::string& tag,
            YAML::EmitterStyle::value style);
  void close();
  void add(Node node);
  void take_key(const Node& node);
  bool is_good_key(const Node& node);
  void report_missing_colon(const Node& node);
  void refuse_key();
  Span span_of_null(std::size_t offset) const;
  void check_tag(std::size_t offset, const std::string& tag);
  void check_escapes(const Node& node);
  std::size_t end_of_scalar(std::size_t offset, const std::string& value);
  Diagnostic& report(Code code, Span span, std::string message);
  [[noreturn]] void stop(Code code, Span span, std::string message, std::string hint);

  const Source& source_;
  const std::string_view text_;
  const std::size_t begin_;
  Diagnostics& diagnostics_;
  std::vector<Frame> frames_;
  std::optional<Node> root_;
  std::size_t nodes_ = 0;
  std::size_t faults_ = 0;
  std::size_t scalar_end_ = 0;
  bool started_ = false;
};

}  // namespace twincraft
