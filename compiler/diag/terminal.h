// The one gate through which text reaches a terminal. What a user wrote (a spec, a flag, the name
// of a file) may hold bytes that drive a terminal: they are shown as escapes, whoever put the text
// together and however. Tested by tests/compiler/diag_test.cpp.
#pragma once

#include <string>
#include <string_view>

namespace twincraft {

/// `file` is a terminal that wants colour: NO_COLOR is respected, and TERM=dumb.
bool wants_colour(int file_descriptor);

/// Lines of text, safe on a terminal: of all control characters only line feeds and tabs are left,
/// and with `colour` the sequences that set colours, `ESC [ digits m`.
std::string for_terminal(std::string_view text, bool colour);

/// A JSON document, safe on a terminal and of the same meaning: JSON itself lets DEL, C1 and
/// characters that reorder text stand in its strings.
std::string json_for_terminal(std::string_view document);

}  // namespace twincraft
