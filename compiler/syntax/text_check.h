// What must hold of a text before YAML sees it: UTF-8, no control characters, no more structure
// than a spec can have. Tested by tests/compiler/load_test.cpp.
#pragma once

#include "compiler/diag/diagnostics.h"

namespace twincraft {

/// Reports the first fault. @return whether the text may be parsed
bool check_text(const Source& source, Diagnostics& diagnostics);

}  // namespace twincraft
