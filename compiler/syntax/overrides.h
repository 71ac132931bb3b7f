// Spec paths: dotted, list members by name or `*`. Used by `--set` and by the members of a study.
// Tested by tests/compiler/overrides_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diag/diagnostics.h"
#include "compiler/syntax/node.h"

namespace twincraft {

/// `PATH=VALUE` of one `--set`.
struct Override {
  std::vector<std::string> path;  // {"panels", "*", "segments"}
  Node value;
  Span span;  // the path, inside the override's own source
};

/// Parse a path alone. Empty on a fault, which is reported at `span`, the place of `text`.
std::vector<std::string> parse_path(std::string_view text, const Span& span,
                                    Diagnostics& diagnostics);

/// Parse `PATH=VALUE`; the text becomes a source of its own named `--set PATH`. Faults are
/// diagnostics.
std::optional<Override> parse_override(std::string_view text, Sources& sources,
                                       Diagnostics& diagnostics);

/// Put the value at its path. Missing maps on the way are made; a list member that does not exist,
/// a `*` without members and a path through a scalar are diagnostics. A null value removes the key
/// or list member, which must be there. A map put in the place of a list member keeps the name of
/// that member unless it brings its own.
/// @return whether anything was set
bool apply(const Override& setting, Node& root, Diagnostics& diagnostics);

}  // namespace twincraft
