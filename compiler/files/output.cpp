// POSIX calls directly: the standard library has no fsync, and its streams hide errno.
// Tested by tests/compiler/output_test.cpp.
#include "compiler/files/output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <system_error>
#include <utility>

#include "compiler/diag/diagnostics.h"
#include "compiler/diag/terminal.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;

/// With the system's own words, in lower case as all our messages.
std::string fault(const std::string& target, int error) {
  std::string reason = std::generic_category().message(error);
  reason[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(reason[0])));
  return fmt::format("cannot write {}: {}", target, reason);
}

std::string fault(const fs::path& path, int error) {
  return fault(in_backticks(path.string()), error);
}

/// @return 0 or errno
int write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// @return empty, or why there is no such folder
std::string make_parent(const fs::path& path) {
  std::error_code error;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
  return error ? fault(path.parent_path(), error.value()) : std::string();
}

/// To standard output. @return empty, or what went wrong
std::string write_bytes(std::string_view bytes) {
  const int error = write_all(STDOUT_FILENO, bytes);
  return error == 0 ? std::string() : fault(std::string("standard output"), error);
}

}  // namespace

PendingFile::PendingFile(fs::path path) : target_(std::move(path)) {
  error_ = make_folder();
  if (error_.empty()) open();
}

PendingFile::PendingFile(PendingFile&& other) noexcept
    : target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      descriptor_(std::exchange(other.descriptor_, -1)),
      error_(std::move(other.error_)) {}

PendingFile::~PendingFile() {
  close();
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

std::string PendingFile::make_folder() const {
  if (std::string error = make_parent(target_); !error.empty()) return error;
  std::error_code error;
  return fs::is_directory(target_, error) ? fault(target_, EISDIR) : std::string();
}

/// Another run may write to the same folder, so the name is tried until it is new.
void PendingFile::open() {
  constexpr int kTries = 100;
  for (int i = 0; i < kTries; ++i) {
    fs::path candidate = target_.parent_path() /
                         fmt::format(".{}.{}-{}.tmp", target_.filename().string(), ::getpid(), i);
    descriptor_ = ::open(candidate.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ >= 0) temporary_ = std::move(candidate);
    if (descriptor_ >= 0 || errno != EEXIST) break;
  }
  if (descriptor_ < 0) error_ = fault(target_, errno);
}

void PendingFile::close() {
  if (descriptor_ < 0) return;
  if (::close(std::exchange(descriptor_, -1)) != 0 && error_.empty())
    error_ = fault(target_, errno);
}

void PendingFile::append(std::string_view text) {
  if (!error_.empty()) return;
  if (const int error = write_all(descriptor_, text); error != 0) error_ = fault(target_, error);
}

void PendingFile::finish() {
  if (descriptor_ >= 0 && error_.empty() && ::fsync(descriptor_) != 0)
    error_ = fault(target_, errno);
  close();
}

std::string PendingFile::publish() {
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) return fault(target_, errno);
  temporary_.clear();
  return {};
}

GrowingFile::GrowingFile(fs::path path, std::uintmax_t keep) : path_(std::move(path)) {
  error_ = make_parent(path_);
  if (!error_.empty()) return;
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    error_ = fault(path_, errno);
    return;
  }
  // A file system without locks does not keep anybody from writing.
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    error_ =
        fmt::format("cannot write {}: another program is writing it", in_backticks(path_.string()));
  else if (::ftruncate(descriptor_, static_cast<off_t>(keep)) != 0)
    error_ = fault(path_, errno);
}

GrowingFile::~GrowingFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void GrowingFile::append(std::string_view text) {
  if (!error_.empty()) return;
  if (const int error = write_all(descriptor_, text); error != 0) error_ = fault(path_, error);
}

std::string publish(std::vector<PendingFile>& files) {
  for (PendingFile& file : files)
    if (std::string error = file.publish(); !error.empty()) return error;
  return {};
}

std::string write_files(const std::vector<OutputFile>& files) {
  std::vector<PendingFile> pending;
  for (const OutputFile& file : files) {
    pending.emplace_back(file.path);
    pending.back().append(file.text);
    pending.back().finish();
    if (!pending.back().error().empty()) return pending.back().error();
  }
  return publish(pending);
}

std::string try_files(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    const PendingFile attempt(path);  // removed again, as it is not published
    if (!attempt.error().empty()) return attempt.error();
  }
  return {};
}

std::string write_standard_output(std::string_view text) {
  return write_bytes(for_terminal(text, wants_colour(STDOUT_FILENO)));
}

std::string write_document(std::string_view bytes) {
  return ::isatty(STDOUT_FILENO) != 0 ? write_standard_output(bytes) : write_bytes(bytes);
}

void write_standard_error(std::string_view text) {
  write_all(STDERR_FILENO, for_terminal(text, wants_colour(STDERR_FILENO)));
}

void survive_failed_writes() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace twincraft
