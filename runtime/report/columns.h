// Rows of cells as text, every column as wide as its widest cell.
// Tested by tests/runtime/sweep_test.cpp.
#pragma once

#include <string>
#include <vector>

namespace twincraft {

using Row = std::vector<std::string>;

/// One line per row, indented by two. @pre at least one row; none is longer than the first
std::string aligned(const std::vector<Row>& rows);

}  // namespace twincraft
