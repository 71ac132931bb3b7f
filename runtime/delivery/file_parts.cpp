// See file_parts.h.
#include "runtime/delivery/file_parts.h"

#include <fmt/format.h>

#include <fstream>
#include <vector>

#include "compiler/diag/diagnostics.h"

namespace twincraft {

std::string read_in_parts(const std::filesystem::path& file,
                          const std::function<void(std::string_view part)>& take) {
  std::ifstream from(file, std::ios::binary);
  std::vector<char> part(1U << 20U);
  while (from) {
    from.read(part.data(), static_cast<std::streamsize>(part.size()));
    take({part.data(), static_cast<std::size_t>(from.gcount())});
  }
  if (from.eof()) return {};
  return fmt::format("cannot read {}", in_backticks(file.string()));
}

std::string copy_in_parts(const std::filesystem::path& file, PendingFile& copy) {
  std::string error = read_in_parts(file, [&copy](std::string_view part) { copy.append(part); });
  if (!error.empty()) return error;
  copy.finish();
  return copy.error();
}

}  // namespace twincraft
