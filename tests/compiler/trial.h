// A spec written in a test, taken through reading, checking and lowering.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "compiler/spec/spec.h"
#include "tests/compiler/schema_reading.h"

namespace twincraft {

struct Trial {
  explicit Trial(std::string written) : text(std::move(written)) {
    spec = spec_table().read(text.root, diagnostics);
    if (!diagnostics.has_errors()) check(spec, diagnostics);
    if (!diagnostics.has_errors()) model = lower(spec, diagnostics);
  }

  /// What was reported, as lines of `line:column code message`.
  std::vector<std::string> faults() const { return lines_of(diagnostics); }

  std::vector<Code> codes() const {
    std::vector<Code> found;
    for (const Diagnostic& fault : diagnostics.all()) found.push_back(fault.code);
    return found;
  }

  Text text;
  Diagnostics diagnostics;
  Spec spec;
  std::optional<Model> model;
};

/// The smallest spec, seven lines, and `more` from line 8 on.
inline std::string brick_with(const std::string& more) {
  return R"(format: spacecraft/1
name: brick
hub:
  mass: 600 kg
  inertia: [400, 380, 360]
simulation: {integrator: rk4, step: 0.02 s, duration: 120 s}
# what the test adds:
)" + more;
}

inline constexpr double kDegree = 3.14159265358979323846 / 180.0;

}  // namespace twincraft
