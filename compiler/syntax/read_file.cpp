// The bytes of a spec. Only regular files and standard input are read: a FIFO could block for ever,
// a device never ends. Tested by tests/compiler/load_test.cpp.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "compiler/syntax/load.h"

namespace twincraft {
namespace {

/// An open file that is closed at the end of the scope; standard input stays open.
class File {
 public:
  explicit File(const std::string& path)
      : descriptor_(path == "-" ? STDIN_FILENO
                                : ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~File() {
    if (descriptor_ > STDIN_FILENO) ::close(descriptor_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

FileText failure(std::string_view what, std::string_view reason) {
  return {{}, fmt::format("cannot read {}: {}", what, reason)};
}

/// What the last system call says, in lower case as all our messages.
std::string system_reason() {
  std::string text = std::generic_category().message(errno);
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') text[0] = static_cast<char>(text[0] + 32);
  return text;
}

std::string too_large() {
  return fmt::format("larger than {} MiB, too large for a spec", kMaximumFileBytes >> 20);
}

/// Empty when `status` is that of something that can be read to its end.
std::string unreadable_kind(const struct stat& status, bool standard_input) {
  if (S_ISDIR(status.st_mode)) return "it is a directory";
  if (S_ISREG(status.st_mode)) {
    const auto limit = static_cast<off_t>(kMaximumFileBytes);
    return status.st_size > limit ? too_large() : std::string();
  }
  if (standard_input) return {};
  return "it is not a regular file";
}

}  // namespace

std::string near_file(const std::string& path) {
  constexpr std::size_t kLooked = 1000;
  const std::filesystem::path missing(path);
  const std::filesystem::path folder = missing.has_parent_path() ? missing.parent_path() : ".";
  std::vector<std::string> names;
  std::error_code fault;
  for (std::filesystem::directory_iterator entry(folder, fault), end;
       !fault && entry != end && names.size() < kLooked; entry.increment(fault)) {
    names.push_back(entry->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return nearest(missing.filename().string(), names);
}

FileText read_file(const std::string& path, std::string_view shown) {
  const std::string what =
      path == "-" ? "standard input" : in_backticks(shown.empty() ? path : shown);
  // Without O_NONBLOCK in File, opening a FIFO that nobody writes to would wait for ever.
  const File file(path);
  if (file.descriptor() < 0) {
    const bool missing = errno == ENOENT;
    const std::string reason = system_reason();
    const std::string near = missing ? near_file(path) : std::string();
    return failure(what, near.empty()
                             ? reason
                             : fmt::format("{}; did you mean {}?", reason, in_backticks(near)));
  }
  struct stat status {};
  if (::fstat(file.descriptor(), &status) != 0) return failure(what, system_reason());
  if (const std::string kind = unreadable_kind(status, path == "-"); !kind.empty()) {
    return failure(what, kind);
  }
  FileText result;
  std::array<char, 65536> buffer;
  while (true) {
    const ssize_t count = ::read(file.descriptor(), buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return failure(what, system_reason());
    if (count == 0) return result;
    result.text.append(buffer.data(), static_cast<std::size_t>(count));
    if (result.text.size() > kMaximumFileBytes) return failure(what, too_large());
  }
}

}  // namespace twincraft
