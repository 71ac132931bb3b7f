// The messages of yaml-cpp name its grammar ("illegal map value"); users need the mistake. Tested
// by tests/compiler/load_test.cpp.
#include "compiler/syntax/yaml_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "compiler/syntax/scan.h"

namespace twincraft {
namespace {

struct Wording {
  std::string_view thrown;  // how yaml-cpp's message begins
  Code code;
  std::string_view message;
  std::string_view hint;
};

constexpr std::string_view kCheckIndentation =
    "check the indentation and the line above; text that contains `: ` needs quotes";
constexpr std::string_view kAnchorHint = "put text that begins with `&` or `*` into quotes";

const std::array kWordings{
    Wording{YAML::ErrorMsg::MAP_VALUE, Code::kYamlSyntax, "a `:` is not expected here",
            kCheckIndentation},
    Wording{YAML::ErrorMsg::MAP_KEY, Code::kYamlSyntax, "a key is not expected here",
            kCheckIndentation},
    Wording{YAML::ErrorMsg::BLOCK_ENTRY, Code::kYamlSyntax, "a list item is not expected here",
            "begin the list on the next line, or write it as `[a, b]`"},
    Wording{YAML::ErrorMsg::END_OF_MAP, Code::kYamlSyntax,
            "this does not belong to the map it stands in",
            "check the indentation; after a closing quote or bracket nothing may follow"},
    Wording{YAML::ErrorMsg::END_OF_SEQ, Code::kYamlSyntax,
            "this does not belong to the list it stands in",
            "check the indentation; after a closing quote or bracket nothing may follow"},
    Wording{YAML::ErrorMsg::FLOW_END, Code::kYamlSyntax, "this bracket closes nothing",
            "delete it, or add the opening one"},
    Wording{YAML::ErrorMsg::UNKNOWN_TOKEN, Code::kYamlSyntax,
            "no value can begin with this character", "put the text into quotes"},
    Wording{YAML::ErrorMsg::CHAR_IN_BLOCK, Code::kYamlSyntax, "text right after `|` or `>`",
            "begin the text on the next line, further indented"},
    Wording{YAML::ErrorMsg::ZERO_INDENT_IN_BLOCK, Code::kYamlSyntax,
            "the indentation of a block cannot be 0", "delete the digit after `|` or `>`"},
    Wording{YAML::ErrorMsg::UNKNOWN_ANCHOR, Code::kAnchor, "YAML aliases are not used here",
            kAnchorHint},
    Wording{YAML::ErrorMsg::ALIAS_NOT_FOUND, Code::kAnchor, "YAML aliases are not used here",
            kAnchorHint},
    Wording{YAML::ErrorMsg::CHAR_IN_ALIAS, Code::kAnchor, "YAML aliases are not used here",
            kAnchorHint},
    Wording{YAML::ErrorMsg::ALIAS_CONTENT, Code::kAnchor, "YAML aliases are not used here",
            kAnchorHint},
    Wording{YAML::ErrorMsg::ANCHOR_NOT_FOUND, Code::kAnchor, "YAML anchors are not used here",
            kAnchorHint},
    Wording{YAML::ErrorMsg::CHAR_IN_ANCHOR, Code::kAnchor, "YAML anchors are not used here",
            kAnchorHint},
    Wording{YAML::ErrorMsg::MULTIPLE_ANCHORS, Code::kAnchor, "YAML anchors are not used here",
            kAnchorHint},
    Wording{YAML::ErrorMsg::MULTIPLE_TAGS, Code::kTag, "YAML tags are not used here",
            "delete the tag"},
    Wording{YAML::ErrorMsg::CHAR_IN_TAG_HANDLE, Code::kTag, "YAML tags are not used here",
            "put text that begins with `!` into quotes"},
    Wording{YAML::ErrorMsg::TAG_WITH_NO_SUFFIX, Code::kTag, "YAML tags are not used here",
            "put text that begins with `!` into quotes"},
    Wording{YAML::ErrorMsg::END_OF_VERBATIM_TAG, Code::kTag, "YAML tags are not used here",
            "put text that begins with `!` into quotes"},
    Wording{YAML::ErrorMsg::BAD_FILE, Code::kTooDeep, "nested too deeply", ""},
};

constexpr Wording kUnknown{"", Code::kYamlSyntax, "this cannot be read as YAML", kCheckIndentation};

bool is_one_of(std::string_view thrown, std::initializer_list<std::string_view> messages) {
  return std::ranges::any_of(messages, [&](std::string_view m) { return thrown.starts_with(m); });
}

class FaultReporter {
 public:
  FaultReporter(const YAML::Exception& fault, const TreeBuilder& builder, const Source& source,
                Diagnostics& diagnostics)
      : thrown_(fault.msg),
        builder_(builder),
        source_(source),
        text_(source.text()),
        diagnostics_(diagnostics),
        at_(builder.offset_of(fault.mark)) {}

  void report() {
    if (report_tab() || report_directive() || report_quote() || report_bracket()) return;
    if (report_escape()) return;
    const auto known = std::ranges::find_if(
        kWordings, [this](const Wording& wording) { return thrown_.starts_with(wording.thrown); });
    const Wording& wording = known == kWordings.end() ? kUnknown : *known;
    // At the end of the text there is nothing to point at but what came last.
    const std::size_t place = at_ < text_.size() ? at_ : last_visible(text_, at_);
    error(wording.code, place, wording.message, wording.hint);
  }

 private:
  Diagnostic& error(Code code, std::size_t at, std::string_view message, std::string_view hint) {
    return diagnostics_.error(code, source_.span(at, 1), std::string(message))
        .with_hint(std::string(hint));
  }

  /// Where the line of the fault begins.
  std::size_t line_begin() const {
    const std::size_t newline = text_.substr(0, at_).rfind('\n');
    return newline == std::string_view::npos ? 0 : newline + 1;
  }

  bool report_tab() {
    const std::size_t begin = line_begin();
    const std::string_view indentation = text_.substr(begin, skip_blanks(text_, begin) - begin);
    const std::size_t tab = indentation.find('\t');
    // Inside brackets indentation means nothing, so a tab is not the cause.
    if (tab == std::string_view::npos || builder_.innermost_bracket()) return false;
    error(Code::kTabIndent, begin + tab, "a tab in the indentation", "indent with blanks");
    return true;
  }

  bool report_directive() {
    const std::size_t begin = line_begin();
    if (char_at(text_, begin) != '%') return false;
    error(Code::kDirective, begin, "YAML directives are not used here", "delete the line");
    return true;
  }

  bool report_quote() {
    if (!is_one_of(thrown_, {YAML::ErrorMsg::EOF_IN_SCALAR, YAML::ErrorMsg::DOC_IN_SCALAR})) {
      return false;
    }
    std::size_t quote = builder_.end_of_last_scalar();
    while (quote < at_ && text_[quote] != '"' && text_[quote] != '\'') {
      const bool comment = text_[quote] == '#';
      quote = comment ? std::min(text_.find('\n', quote), at_) : quote + 1;
    }
    error(Code::kUnclosedQuote, std::min(quote, last_visible(text_, text_.size())),
          "this quote is never closed", "close it at the end of its text");
    return true;
  }

  bool report_bracket() {
    const std::optional<std::size_t> open = builder_.innermost_bracket();
    if (!open) return false;
    const char bracket = text_[*open];
    const char partner = bracket == '[' ? ']' : '}';
    if (is_one_of(thrown_, {YAML::ErrorMsg::END_OF_SEQ_FLOW, YAML::ErrorMsg::END_OF_MAP_FLOW})) {
      Diagnostic& fault =
          error(Code::kUnclosedBracket, *open, fmt::format("this `{}` is not closed", bracket),
                fmt::format("close it with `{}`", partner));
      if (at_ < text_.size()) fault.with_note(source_.span(at_, 1), "needed before this");
      return true;
    }
    if (!is_one_of(thrown_, {YAML::ErrorMsg::FLOW_END})) return false;
    error(Code::kUnclosedBracket, at_,
          fmt::format("`{}` where `{}` is needed", char_at(text_, at_), partner), "")
        .with_note(source_.span(*open, 1), "to close this bracket");
    return true;
  }

  bool report_escape() {
    if (!is_one_of(thrown_, {YAML::ErrorMsg::INVALID_ESCAPE, YAML::ErrorMsg::INVALID_HEX,
                             YAML::ErrorMsg::INVALID_UNICODE})) {
      return false;
    }
    const std::size_t backslash = text_.substr(0, at_).rfind('\\');
    error(Code::kYamlSyntax, std::min(backslash, at_), "not an escape that YAML knows",
          "write a backslash as `\\\\`, or use single quotes, which know no escapes");
    return true;
  }

  std::string_view thrown_;
  const TreeBuilder& builder_;
  const Source& source_;
  std::string_view text_;
  Diagnostics& diagnostics_;
  std::size_t at_;
};

}  // namespace

void report_yaml_fault(const YAML::Exception& fault, const TreeBuilder& builder,
                       const Source& source, Diagnostics& diagnostics) {
  FaultReporter(fault, builder, source, diagnostics).report();
}

}  // namespace twincraft
