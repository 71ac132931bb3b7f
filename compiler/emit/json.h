// JSON as this compiler writes it: keys in the order given, numbers as the shortest text that reads
// back as the same double, a list of plain values on one line. The same value always gives the same
// bytes. Tested by tests/compiler/emit_test.cpp.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace twincraft {

/// Ends with a line feed. @pre all numbers are finite
std::string json_text(const nlohmann::ordered_json& value);

/// A plain value as JSON writes it: text in quotes, a number in its shortest form.
std::string json_scalar(const nlohmann::ordered_json& value);

/// A list without maps inside, written on one line: `[[0, 0.1], [5, -0.1]]`.
bool fits_one_line(const nlohmann::ordered_json& value);
std::string one_line(const nlohmann::ordered_json& value);

}  // namespace twincraft
