// Text to tree: check the characters, let yaml-cpp parse, let the builder judge. Of a second
// document one event is enough, so yaml-cpp is asked for it exactly once: its own loop over
// documents never ends on a lone `,`. Tested by tests/compiler/load_test.cpp.
#include "compiler/syntax/load.h"

#include <fmt/format.h>
#include <yaml-cpp/parser.h>

#include <sstream>

#include "compiler/syntax/text_check.h"
#include "compiler/syntax/tree_builder.h"
#include "compiler/syntax/yaml_faults.h"

namespace twincraft {
namespace {

struct Document {
  bool good = false;
  std::optional<Node> root;  // none: the text holds nothing
};

Document parse_document(const Source& source, std::size_t begin, Diagnostics& diagnostics) {
  if (!check_text(source, diagnostics)) return {};
  const std::size_t errors_before = diagnostics.error_count();
  TreeBuilder builder(source, begin, diagnostics);
  try {
    std::istringstream stream(source.text().substr(begin));
    YAML::Parser parser(stream);
    if (parser.HandleNextDocument(builder)) parser.HandleNextDocument(builder);
  } catch (const StopParsing&) {
    return {};
  } catch (const YAML::Exception& fault) {
    report_yaml_fault(fault, builder, source, diagnostics);
    return {};
  }
  if (diagnostics.error_count() > errors_before) return {};
  return {true, builder.take_root()};
}

void report_root(const Source& source, const Node& root, Diagnostics& diagnostics) {
  if (root.is_null()) {
    diagnostics.error(Code::kEmptyDocument, source.span(0, 0), "the spec is empty")
        .with_hint("begin with `format: spacecraft/1`");
    return;
  }
  Diagnostic& fault = diagnostics.error(
      Code::kRootNotMap, root.span,
      fmt::format("the spec is {}, a map of sections is expected", describe(root)));
  if (root.is_scalar() && root.scalar.find(':') != std::string::npos) {
    fault.with_hint("put a blank after the colon: `key: value`");
  }
}

}  // namespace

std::optional<Node> parse(const Source& source, Diagnostics& diagnostics) {
  Document document = parse_document(source, 0, diagnostics);
  if (!document.good) return std::nullopt;
  if (document.root && document.root->is_map()) return std::move(document.root);
  report_root(source, document.root.value_or(Node{}), diagnostics);
  return std::nullopt;
}

std::optional<Node> parse_value(const Source& source, Diagnostics& diagnostics, std::size_t begin) {
  Document document = parse_document(source, begin, diagnostics);
  if (!document.good) return std::nullopt;
  if (document.root) return std::move(document.root);
  if (source.text().find('#', begin) != std::string::npos) {
    diagnostics.error(Code::kEmptyDocument, source.span(begin, 1), "the value is only a comment")
        .with_hint("put text that begins with `#` into quotes");
    return std::nullopt;
  }
  Node nothing;
  nothing.span = source.span(begin, 0);
  return nothing;
}

}  // namespace twincraft
