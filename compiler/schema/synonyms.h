// What other tools, textbooks and habits call things: `sma`, `dt`, `reaction_wheels`, joint type
// `hinge`. The words are in synonyms.def. Tested by tests/compiler/synonyms_test.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compiler/schema/reading.h"

namespace twincraft {

/// The hint for an unknown key: the key of this table that is meant, or what to do instead. Empty
/// when nobody is known to say so.
std::string hint_for_key(const TableInfo& info, std::string_view key);

/// The hint for a word that is none of `words`; empty when nothing is near.
std::string hint_for_word(std::string_view word, const std::vector<std::string>& words);

}  // namespace twincraft
