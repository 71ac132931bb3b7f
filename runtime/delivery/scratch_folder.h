// A folder of our own under the system's temporary directory, for as long as the object lives.
// Tested by tests/runtime/delivery_test.cpp.
#pragma once

#include <filesystem>
#include <string>

namespace twincraft {

class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  /// Empty, or why there is none.
  const std::string& error() const { return error_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::string error_;
};

}  // namespace twincraft
