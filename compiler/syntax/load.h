// Text to syntax tree: the one hardened way into the program. YAML's traps (anchors, aliases,
// merge keys, duplicate keys, several documents, NUL, bad encodings, deep nesting) end here as
// diagnostics. Scalars stay text; the schema gives them meaning.
// Tested by tests/compiler/load_test.cpp and tests/malformed.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "compiler/diag/diagnostics.h"
#include "compiler/syntax/node.h"

namespace twincraft {

// A spec is text a person wrote. These keep every answer below a second and 100 MB, however
// hostile.
inline constexpr std::size_t kMaximumFileBytes = 4u << 20;
inline constexpr std::size_t kMaximumNodes = 200'000;
inline constexpr std::size_t kMaximumIndicators = 1'000'000;
inline constexpr int kMaximumDepth = 64;

/// The bytes of a file, or of standard input for `-`; an I/O fault comes back as text. Never blocks
/// on a FIFO or reads from a device: those are faults. `shown` is what the fault calls the file.
struct FileText {
  std::string text;
  std::string error;  // empty: read
};
FileText read_file(const std::string& path, std::string_view shown = {});

/// The name of the file that `path`, which does not exist, probably meant; empty when its folder
/// has none of a similar name.
std::string near_file(const std::string& path);

/// Parse one document whose root is a map. Nothing on error; all faults are in `diagnostics`.
std::optional<Node> parse(const Source& source, Diagnostics& diagnostics);

/// Parse the text from offset `begin` on, such as the value of an override, which may be any node;
/// blank text is null.
std::optional<Node> parse_value(const Source& source, Diagnostics& diagnostics,
                                std::size_t begin = 0);

}  // namespace twincraft
