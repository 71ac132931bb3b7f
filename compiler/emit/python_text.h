// Data as Python writes it: literals, broken where a line would be
// longer than 119 characters. Tested by tests/compiler/basilisk_test.cpp.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace twincraft {

inline constexpr std::size_t kScriptLine = 119;  // characters

/// `NAME = literal`, with its line end. @pre all numbers are finite
/// @param comment  where there is room behind the first line, else above it
std::string assignment(std::string_view name, const nlohmann::ordered_json& value,
                       std::string_view comment = "");

/// Text for people as comment lines or inside a docstring, broken at blanks; lines after the first
/// begin with `indent`. What a docstring or a line cannot hold is escaped.
/// @param first  what the first line begins with
std::string wrapped(std::string_view text, std::string_view first, std::string_view indent);

/// Words after one another, on lines that end before they are too long.
std::string filled(std::string_view words, std::string_view first, std::string_view indent);

/// Marks of a text, and what stands for them.
using Words = std::vector<std::pair<std::string_view, std::string_view>>;
std::string with(std::string_view text, const Words& words);

}  // namespace twincraft
