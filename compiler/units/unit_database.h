// Where UDUNITS' database is, for a program or library that brings its own.
// Tested by tests/compiler/units_test.cpp.
#pragma once

#include <filesystem>

namespace twincraft {

/// `udunits/udunits2.xml` in the folder of a binary, or one above; empty: in neither.
std::filesystem::path unit_database_beside(const std::filesystem::path& binary);

/// Of the binary that this code is in. Empty where it has none, or where the user's environment
/// names one: then UDUNITS finds it by itself.
std::filesystem::path own_unit_database();

}  // namespace twincraft
