// Any bytes become a syntax tree or diagnostics, never both and never neither; what is said about
// them is printable in all three forms.
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "compiler/diag/print.h"
#include "compiler/syntax/load.h"
#include "tests/fuzz/claim.h"

using namespace twincraft;

namespace {

bool is_printable(const std::string& text) {
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x20 && c != '\n') || byte == 0x7f) return false;
  }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Sources sources;
  Diagnostics diagnostics;
  const Source& source =
      sources.add("fuzz.yaml", std::string(reinterpret_cast<const char*>(data), size));
  const std::optional<Node> root = parse(source, diagnostics);
  fuzz::claim(root.has_value() != diagnostics.has_errors());
  fuzz::claim(is_printable(to_text(diagnostics, {})));
  if (!diagnostics.has_errors()) return 0;
  fuzz::claim(nlohmann::json::accept(to_json(diagnostics)));
  fuzz::claim(nlohmann::json::accept(to_sarif(diagnostics)));
  return 0;
}
