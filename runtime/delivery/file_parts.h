// A file read in parts of a megabyte, because it may be larger than memory.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "compiler/files/output.h"

namespace twincraft {

/// @return empty, or that it cannot be read
std::string read_in_parts(const std::filesystem::path& file,
                          const std::function<void(std::string_view part)>& take);

/// The same into another one. @return empty, or what cannot be read or written
std::string copy_in_parts(const std::filesystem::path& file, PendingFile& copy);

}  // namespace twincraft
