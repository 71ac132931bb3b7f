// See scratch_folder.h.
#include "runtime/delivery/scratch_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "compiler/diag/diagnostics.h"

namespace twincraft {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  std::string name = (parent / "twincraft-XXXXXX").string();
  if (!error && ::mkdtemp(name.data()) == nullptr) error.assign(errno, std::generic_category());
  if (error)
    error_ = fmt::format(
        "cannot make a folder in {}: {}",
        parent.empty() ? "the system's temporary directory" : in_backticks(parent.string()),
        error.message());
  else
    path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

}  // namespace twincraft
