// Diagnostics for programs: JSON as pinned in the interface, and SARIF 2.1.0. Bytes that are no
// UTF-8 are replaced, because JSON cannot carry them. Tested by tests/compiler/diag_test.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "compiler/diag/print.h"
#include "compiler/diag/terminal.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

std::string dumped(const Json& json) {
  return json_for_terminal(json.dump(2, ' ', false, Json::error_handler_t::replace)) + "\n";
}

Json placed(const Span& span) {
  const bool known = span.source != nullptr;
  return {{"file", known ? span.source->name() : ""},
          {"line", known ? Json(span.line) : Json(nullptr)},
          {"column", known ? Json(span.column) : Json(nullptr)},
          {"end_column", known ? Json(span.column + span.length) : Json(nullptr)}};
}

Json as_json(const Diagnostic& diagnostic) {
  Json json = {{"severity", severity_name(diagnostic.severity)},
               {"code", code_name(diagnostic.code)}};
  json.update(placed(diagnostic.span));
  json["message"] = diagnostic.message;
  json["hint"] = diagnostic.hint;
  json["notes"] = Json::array();
  for (const Note& note : diagnostic.notes) {
    Json item = placed(note.span);
    item["message"] = note.message;
    json["notes"].push_back(std::move(item));
  }
  return json;
}

/// A file name as the URI reference that SARIF asks for.
std::string uri_of(std::string_view name) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  std::string uri;
  for (const char c : name) {
    if (kPlain.find(c) != std::string_view::npos) {
      uri += c;
    } else {
      uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return uri;
}

/// SARIF counts characters where we count bytes.
int character_column(const Span& span, int byte_column) {
  const std::string_view line = span.source->line(span.line);
  const auto bytes = std::min(line.size(), static_cast<std::size_t>(byte_column - 1));
  const auto continuing = std::ranges::count_if(
      line.substr(0, bytes), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; });
  return byte_column - static_cast<int>(continuing);
}

Json sarif_location(const Span& span) {
  const Json region = {{"startLine", span.line},
                       {"startColumn", character_column(span, span.column)},
                       {"endColumn", character_column(span, span.column + span.length)}};
  return {{"physicalLocation",
           {{"artifactLocation", {{"uri", uri_of(span.source->name())}}}, {"region", region}}}};
}

Json sarif_result(const Diagnostic& diagnostic) {
  std::string text = diagnostic.message;
  if (!diagnostic.hint.empty()) text += fmt::format("\nhint: {}", diagnostic.hint);
  Json result = {{"ruleId", code_name(diagnostic.code)},
                 {"level", severity_name(diagnostic.severity)},
                 {"message", {{"text", text}}}};
  if (diagnostic.span.source != nullptr) {
    result["locations"] = Json::array({sarif_location(diagnostic.span)});
  }
  for (const Note& note : diagnostic.notes) {
    if (note.span.source == nullptr) continue;
    Json location = sarif_location(note.span);
    location["message"]["text"] = note.message;
    result["relatedLocations"].push_back(std::move(location));
  }
  return result;
}

}  // namespace

std::string to_json(const Diagnostics& diagnostics) {
  Json list = Json::array();
  for (const Diagnostic& diagnostic : diagnostics.sorted()) list.push_back(as_json(diagnostic));
  return dumped({{"diagnostics", std::move(list)}});
}

std::string to_sarif(const Diagnostics& diagnostics) {
  const std::vector<Diagnostic> sorted = diagnostics.sorted();
  std::set<Code> mentioned;
  Json results = Json::array();
  for (const Diagnostic& diagnostic : sorted) {
    mentioned.insert(diagnostic.code);
    results.push_back(sarif_result(diagnostic));
  }
  Json rules = Json::array();
  for (const Code code : mentioned) {
    rules.push_back({{"id", code_name(code)},
                     {"shortDescription", {{"text", code_title(code)}}},
                     {"fullDescription", {{"text", code_explanation(code)}}}});
  }
  const Json driver = {{"name", "sccompile"}, {"version", TWINCRAFT_VERSION}, {"rules", rules}};
  const Json run = {{"tool", {{"driver", driver}}},
                    {"columnKind", "unicodeCodePoints"},
                    {"results", std::move(results)}};
  return dumped({{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                 {"version", "2.1.0"},
                 {"runs", Json::array({run})}});
}

}  // namespace twincraft
