// The reference of the language as Markdown, from the same field tables that read it.
// Tested by tests/compiler/schema_test.cpp.
#pragma once

#include <string>

#include "compiler/schema/reading.h"

namespace twincraft {

/// For `root` and every table below it, each once: a heading, what it is, and its keys with kind,
/// default and meaning.
std::string reference_text(const TableInfo& root);

}  // namespace twincraft
