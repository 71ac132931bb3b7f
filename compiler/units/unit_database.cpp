// See unit_database.h.
#include "compiler/units/unit_database.h"

#include <dlfcn.h>
#include <link.h>

#include <cstdlib>
#include <system_error>

namespace twincraft {
namespace {

namespace fs = std::filesystem;

/// The library that this code is in; a program has no name there.
fs::path this_binary() {
  static const char here = 0;
  Dl_info symbol{};
  link_map* map = nullptr;
  const bool is_found =
      dladdr1(&here, &symbol, reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP) != 0;
  if (is_found && map != nullptr && map->l_name != nullptr && *map->l_name != '\0')
    return map->l_name;
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored);
}

}  // namespace

fs::path unit_database_beside(const fs::path& binary) {
  std::error_code ignored;
  const fs::path folder = fs::absolute(binary, ignored).lexically_normal().parent_path();
  for (const fs::path& place : {folder, folder.parent_path()})
    if (fs::path file = place / "udunits" / "udunits2.xml"; fs::is_regular_file(file, ignored))
      return file;
  return {};
}

fs::path own_unit_database() {
  const char* users = std::getenv("UDUNITS2_XML_PATH");
  if (users != nullptr && *users != '\0') return {};
  return unit_database_beside(this_binary());
}

}  // namespace twincraft
