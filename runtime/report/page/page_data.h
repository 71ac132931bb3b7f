// Everything a page shows, as one JSON document: report.json as it is, what its metrics are called,
// and what only a picture needs. Tested by tests/runtime/html_test.cpp.
#pragma once

#include <string>

#include "runtime/study/results.h"

namespace twincraft {

/// Text that may stand inside a script element: no `<` in it.
std::string page_data(const Report& report);

}  // namespace twincraft
