// yaml-cpp accepts more than YAML does: keys without a colon, quotes that are never closed, empty
// places between commas, text after the end. The source text at each mark tells. Tested by
// tests/compiler/load_test.cpp.
#include "compiler/syntax/tree_builder.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/diag/utf8.h"
#include "compiler/syntax/load.h"
#include "compiler/syntax/scan.h"

namespace twincraft {
namespace {

constexpr std::size_t kMaximumFaults = 100;  // more explain nothing and could fill the memory

std::string_view word_of(Node::Kind kind) { return kind == Node::Kind::kList ? "list" : "map"; }

}  // namespace

TreeBuilder::TreeBuilder(const Source& source, std::size_t begin, Diagnostics& diagnostics)
    : source_(source),
      text_(source.text()),
      begin_(begin),
      diagnostics_(diagnostics),
      scalar_end_(begin) {}

std::size_t TreeBuilder::offset_of(const YAML::Mark& mark) const {
  if (mark.is_null()) return scalar_end_;
  return std::min(begin_ + static_cast<std::size_t>(mark.pos), text_.size());
}

bool TreeBuilder::is_implicit_pair(const Frame& frame) const {
  const char first = char_at(text_, frame.offset);
  return frame.in_brackets && first != '[' && first != '{';
}

std::optional<std::size_t> TreeBuilder::innermost_bracket() const {
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame) {
    if (frame->in_brackets && !is_implicit_pair(*frame)) return frame->offset;
  }
  return std::nullopt;
}

void TreeBuilder::OnDocumentStart(const YAML::Mark& mark) {
  const std::size_t offset = offset_of(mark);
  if (started_) {
    if (begins_document(text_, offset)) {
      stop(Code::kSeveralDocuments, source_.span(offset, 1), "a second document begins here",
           "put it into a file of its own");
    }
    stop(Code::kYamlSyntax, source_.span(offset, 1), "this does not belong to what stands above",
         "check the indentation and the brackets above");
  }
  started_ = true;
  if (const auto directive = find_directive(text_, begin_, offset)) {
    report(Code::kDirective, source_.span(*directive, 1), "YAML directives are not used here")
        .with_hint("delete the line");
  }
}

void TreeBuilder::OnNull(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) {
  const std::size_t offset = offset_of(mark);
  if (char_at(text_, offset) == ',') {
    if (frames_.empty()) {
      stop(Code::kYamlSyntax, source_.span(offset, 1), "a `,` is not expected here",
           "lists are written `[1, 2, 3]`");
    }
    if (frames_.back().node.is_list() || expects_key()) {
      report(Code::kMissingEntry, source_.span(offset, 1), "nothing stands before this comma")
          .with_hint("write the value or delete the comma");
      if (expects_key()) return refuse_key();
    }
  }
  Node node;
  node.span = span_of_null(offset);
  add(std::move(node));
}

void TreeBuilder::OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) {
  const std::size_t offset = offset_of(mark);
  const std::size_t length = end_of_word(text_, offset) - offset;
  report(
      Code::kAnchor, source_.span(offset, length),
      fmt::format("YAML aliases are not used here: {}", in_backticks(text_.substr(offset, length))))
      .with_hint("write the value out, or share parts of specs with `extends`");
  if (expects_key()) return refuse_key();
  Node node;
  node.span = source_.span(offset, length);
  add(std::move(node));
}

void TreeBuilder::OnAnchor(const YAML::Mark& mark, const std::string& name) {
  report(Code::kAnchor, source_.span(offset_of(mark), name.size() + 1),
         fmt::format("YAML anchors are not used here: {}", in_backticks("&" + name)))
      .with_hint("write the value out, or share parts of specs with `extends`");
}

void TreeBuilder::OnScalar(const YAML::Mark& mark, const std::string& tag,
                           YAML::anchor_t /*anchor*/, const std::string& value) {
  const std::size_t offset = offset_of(mark);
  check_tag(offset, tag);
  scalar_end_ = end_of_scalar(offset, value);
  Node node;
  node.kind = Node::Kind::kScalar;
  node.scalar = value;
  node.quoted = tag == "!";
  node.span = source_.span(offset, length_on_line(text_, offset, scalar_end_));
  check_escapes(node);
  add(std::move(node));
}

void TreeBuilder::OnSequenceStart(const YAML::Mark& mark, const std::string& tag,
                                  YAML::anchor_t /*anchor*/, YAML::EmitterStyle::value style) {
  open(Node::Kind::kList, mark, tag, style);
}

void TreeBuilder::OnSequenceEnd() { close(); }

void TreeBuilder::OnMapStart(const YAML::Mark& mark, const std::string& tag,
                             YAML::anchor_t /*anchor*/, YAML::EmitterStyle::value style) {
  open(Node::Kind::kMap, mark, tag, style);
}

void TreeBuilder::OnMapEnd() { close(); }

bool TreeBuilder::expects_key() const {
  return !frames_.empty() && frames_.back().node.is_map() && !frames_.back().has_key;
}

void TreeBuilder::open(Node::Kind kind, const YAML::Mark& mark, const std::string& tag,
                       YAML::EmitterStyle::value style) {
  const std::size_t offset = offset_of(mark);
  check_tag(offset, tag);
  Frame frame;
  frame.node.kind = kind;
  frame.node.span = source_.span(offset, 1);
  frame.offset = offset;
  frame.in_brackets = style == YAML::EmitterStyle::Flow;
  if (frames_.size() >= static_cast<std::size_t>(kMaximumDepth)) {
    stop(Code::kTooDeep, frame.node.span,
         fmt::format("this {} is nested more than {} levels deep", word_of(kind), kMaximumDepth),
         "");
  }
  frames_.push_back(std::move(frame));
}

void TreeBuilder::close() {
  Node node = std::move(frames_.back().node);
  frames_.pop_back();
  add(std::move(node));
}

void TreeBuilder::add(Node node) {
  if (expects_key()) return take_key(node);
  if (++nodes_ > kMaximumNodes) {
    stop(Code::kTooLarge, node.span, fmt::format("more than {} values", kMaximumNodes), "");
  }
  if (frames_.empty()) {
    root_ = std::move(node);
    return;
  }
  Frame& frame = frames_.back();
  if (frame.node.is_map()) {
    frame.has_key = false;
    if (!frame.keeps_value) return;
    frame.node.keys.push_back(std::move(frame.key));
  }
  frame.node.items.push_back(std::move(node));
}

void TreeBuilder::take_key(const Node& node) {
  if (!is_good_key(node)) return refuse_key();
  Frame& frame = frames_.back();
  const auto [first, is_new] = frame.seen.emplace(node.scalar, node.span);
  if (!is_new) {
    report(Code::kDuplicateKey, node.span,
           fmt::format("key {} is written twice", in_backticks(node.scalar)))
        .with_hint("delete one of the two")
        .with_note(first->second, "first written here");
    return refuse_key();
  }
  frame.has_key = true;
  frame.keeps_value = true;
  frame.key = {node.scalar, node.span};
}

bool TreeBuilder::is_good_key(const Node& node) {
  if (!node.is_scalar() || node.scalar.empty()) {
    const std::string found = node.is_scalar() ? "an empty text" : describe(node);
    report(Code::kBadKey, node.span, fmt::format("{} cannot be a key", found))
        .with_hint("write `key: value`");
    return false;
  }
  if (node.scalar == "<<") {
    report(Code::kMergeKey, node.span, "YAML merge keys are not used here")
        .with_hint("start from another spec with `extends: other.yaml`");
    return false;
  }
  const char next = char_at(text_, skip_blanks(text_, scalar_end_));
  if (next == ':') return true;
  if (next == '&' || next == '!') return false;  // an anchor or tag, reported already
  if (is_implicit_pair(frames_.back())) {
    // yaml-cpp takes the last entry of a list for a key when the text ends before the `]`.
    stop(Code::kUnclosedBracket, source_.span(*innermost_bracket(), 1), "this `[` is not closed",
         "close it with `]`");
  }
  report_missing_colon(node);
  return false;
}

void TreeBuilder::report_missing_colon(const Node& node) {
  Diagnostic& fault = report(Code::kMissingColon, node.span,
                             fmt::format("no `: ` after key {}", in_backticks(node.scalar)));
  fault.with_hint("write `key: value`");
  const std::size_t colon = node.scalar.find(':');
  if (!node.quoted && colon != std::string::npos) {
    fault.with_hint(fmt::format("put a blank after the colon: {}",
                                in_backticks(fmt::format("{}: {}", node.scalar.substr(0, colon),
                                                         node.scalar.substr(colon + 1)))));
  }
}

void TreeBuilder::refuse_key() {
  frames_.back().has_key = true;
  frames_.back().keeps_value = false;
}

Span TreeBuilder::span_of_null(std::size_t offset) const {
  if (const std::size_t length = length_of_null(text_, offset);
      length > 0 && char_at(text_, skip_blanks(text_, offset + length)) != ':') {
    return source_.span(offset, length);
  }
  // For an empty place yaml-cpp marks the token that follows, perhaps lines below; the `:` or `-`
  // that the value is missing from is the better place.
  const bool after_key = !frames_.empty() && frames_.back().node.is_map();
  const std::size_t sign =
      after_key ? skip_blanks(text_, scalar_end_) : last_visible(text_, offset);
  const char found = char_at(text_, sign);
  if (found == ':' || found == '-') return source_.span(sign, 1);
  return source_.span(offset, 1);
}

void TreeBuilder::check_tag(std::size_t offset, const std::string& tag) {
  const bool written = char_at(text_, offset) == '!';
  if (!written && (tag.empty() || tag == "?" || tag == "!")) return;
  const std::size_t length = written ? end_of_word(text_, offset) - offset : 1;
  report(Code::kTag, source_.span(offset, length), "YAML tags are not used here")
      .with_hint("delete the tag");
}

void TreeBuilder::check_escapes(const Node& node) {
  for (std::size_t at = 0; at < node.scalar.size();) {
    const Utf8Character character = decode_utf8(node.scalar, at);
    const bool allowed = character.code == '\n' || character.code == '\t' || character.code == 0x85;
    if (is_control(character.code) && !allowed) {
      report(Code::kControlCharacter, node.span,
             fmt::format("an escape gives the control character U+{:04X}",
                         static_cast<unsigned>(character.code)));
      return;
    }
    at += std::max<std::size_t>(1, character.length);
  }
}

std::size_t TreeBuilder::end_of_scalar(std::size_t offset, const std::string& value) {
  const char first = char_at(text_, offset);
  if (first == '&' || first == '!') return offset;  // refused already
  if (first != '"' && first != '\'') return end_of_plain(text_, offset, value);
  const std::optional<std::size_t> closing = find_closing_quote(text_, offset);
  if (!closing) {
    stop(Code::kUnclosedQuote, source_.span(offset, 1), "this quote is never closed",
         "close it at the end of its text");
  }
  return *closing + 1;
}

Diagnostic& TreeBuilder::report(Code code, Span span, std::string message) {
  if (++faults_ > kMaximumFaults) throw StopParsing{};
  return diagnostics_.error(code, span, std::move(message));
}

void TreeBuilder::stop(Code code, Span span, std::string message, std::string hint) {
  report(code, span, std::move(message)).with_hint(std::move(hint));
  throw StopParsing{};
}

}  // namespace twincraft
