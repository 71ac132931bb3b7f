// Specs that start from another one: `extends: base.yaml` and `drop: [names]`. The files are merged
// as syntax trees before anything else looks at them, so overrides, studies and all checks see one
// spec; what came from a file keeps pointing into it.
//
// Maps merge by key and lists of named members by `name`; every other value, and every other list,
// replaces what it meets. `null` in the place of an inherited value takes it away. `drop` works on
// what is inherited, before the file's own members are put in.
//
// Which files may be read: those in the folder tree of the file that is compiled. An author who
// keeps specs in several folders puts an empty file `.twincraft` into the one above them all; the
// nearest such folder is then the tree. Symbolic links are followed first and must stay inside.
// Tested by tests/compiler/extends_test.cpp and tests/malformed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/diag/diagnostics.h"
#include "compiler/syntax/node.h"

namespace twincraft {

inline constexpr std::size_t kMaximumExtends = 16;  // files below the one that is compiled
inline constexpr const char* kTreeMarker = ".twincraft";

/// What a spec is made of.
struct Extended {
  std::string text;                // of the spec, followed by that of each file down the chain
  std::vector<std::string> files;  // of the chain, without the spec itself
};

/// Merge into `root` all that it extends, and take `extends` and `drop` out of it. Faults are
/// diagnostics, at the value of `extends` or the name to be dropped.
/// @param file  the path of `source`; `-`, standard input, is in no folder and extends nothing
/// @return nothing on a fault
std::optional<Extended> resolve_extends(Node& root, const Source& source, const std::string& file,
                                        Sources& sources, Diagnostics& diagnostics);

/// Whether `root` is free of `extends` and `drop`. After resolve_extends() only an override can
/// have brought them; it is told that it comes too late.
bool refuse_late_extends(const Node& root, Diagnostics& diagnostics);

/// `own` on top of `base`.
Node merge(Node base, Node own);

}  // namespace twincraft
