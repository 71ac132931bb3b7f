// An attribution as a page for people: the differences, what carries them, what is left.
// Tested by tests/runtime/attribution_test.cpp.
#pragma once

#include <string>

#include "runtime/study/results.h"

namespace twincraft {

/// @pre the report has an attribution
std::string attribution_table(const Report& report, bool colour);

}  // namespace twincraft
