// Any `PATH=VALUE` is applied to a spec or refused with words.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "compiler/diag/print.h"
#include "compiler/syntax/load.h"
#include "compiler/syntax/overrides.h"
#include "tests/fuzz/claim.h"

using namespace twincraft;

namespace {

constexpr const char* kSpec =
    "format: spacecraft/1\n"
    "name: x\n"
    "hub: {mass: 600, inertia: [400, 380, 360]}\n"
    "wheels:\n"
    "  - {name: a, axis: [1, 0, 0]}\n"
    "  - {name: b, axis: [0, 1, 0]}\n"
    "panels: []\n";

const Node& spec() {
  static Sources sources;
  static Diagnostics none;
  static const Node root = *parse(sources.add("spec.yaml", kSpec), none);
  return root;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Sources sources;
  Diagnostics diagnostics;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::optional<Override> setting = parse_override(text, sources, diagnostics);
  fuzz::claim(setting.has_value() != diagnostics.has_errors());
  if (setting) {
    Node root = spec();
    fuzz::claim(apply(*setting, root, diagnostics) != diagnostics.has_errors());
  }
  fuzz::claim(to_text(diagnostics, {}).empty() == diagnostics.all().empty());
  return 0;
}
