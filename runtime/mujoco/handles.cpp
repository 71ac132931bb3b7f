// Decides how MuJoCo's errors and warnings leave it, and that models are loaded from memory.
// Tested by tests/runtime/mujoco_test.cpp.
#include "runtime/mujoco/handles.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "runtime/engine/engine.h"

namespace twincraft {
namespace {

constexpr const char* kFileName = "model.xml";

// MuJoCo reports a warning on the thread that caused it, so no lock is needed.
thread_local std::vector<std::string> warnings;

[[noreturn]] void throw_error(const char* message) {
  throw NumericalFailure(fmt::format("mujoco: {}", message));
}

void keep_warning(const char* message) { warnings.emplace_back(message); }

// MuJoCo wants its memory on cache lines. glibc 2.36 does not find what it gave out aligned again
// once it is free: half a megabyte an engine, which a study of thousands would keep. So memory is
// taken with a margin, and what malloc gave is noted before what MuJoCo gets.
constexpr std::size_t kAlignment = 64;

void* allocate(std::size_t size) {
  void* taken = std::malloc(size + 2 * kAlignment);
  if (taken == nullptr) return nullptr;
  void* room = static_cast<std::byte*>(taken) + kAlignment;
  std::size_t space = size + kAlignment;
  void** given = static_cast<void**>(std::align(kAlignment, size, room, space));
  given[-1] = taken;
  return static_cast<void*>(given);
}

void release(void* given) {
  if (given != nullptr) std::free(static_cast<void**>(given)[-1]);
}

// The hooks are plain globals of the library: set once, before anything of it is used.
void install_hooks() {
  [[maybe_unused]] static const bool installed = [] {
    mju_user_malloc = allocate;
    mju_user_free = release;
    mju_user_error = throw_error;
    mju_user_warning = keep_warning;
    return true;
  }();
}

/// One file in memory as long as this lives. An mjVFS holds its table of names by value, two
/// megabytes: never on the stack, and one for all, because clearing it is half of loading a small
/// model. @pre one at a time
class FileInMemory {
 public:
  explicit FileInMemory(const std::string& text) {
    if (mj_makeEmptyFileVFS(&files(), kFileName, static_cast<int>(text.size())) != 0) {
      throw NumericalFailure("mujoco: can not hold the model in memory");
    }
    std::memcpy(files().filedata[mj_findFileVFS(&files(), kFileName)], text.data(), text.size());
  }
  FileInMemory(const FileInMemory&) = delete;
  FileInMemory& operator=(const FileInMemory&) = delete;
  ~FileInMemory() { mj_deleteFileVFS(&files(), kFileName); }

  static mjVFS& files() {
    static const std::unique_ptr<mjVFS> vfs = [] {
      auto empty = std::make_unique_for_overwrite<mjVFS>();
      mj_defaultVFS(empty.get());
      return empty;
    }();
    return *vfs;
  }
};

}  // namespace

MujocoModel load_mjcf(const std::string& mjcf) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  install_hooks();
  take_mujoco_warnings();  // of whatever ran before
  const FileInMemory file(mjcf);
  std::array<char, 1000> error{};
  MujocoModel model(
      mj_loadXML(kFileName, &FileInMemory::files(), error.data(), static_cast<int>(error.size())));
  if (!model) {
    throw NumericalFailure(fmt::format("mujoco: {} {}", error.data(), take_mujoco_warnings()));
  }
  return model;
}

void hide_pictures(mjModel& model) {
  model.ngeom = 0;
  model.nsite = 0;
}

MujocoModel copy_of(const mjModel& model) {
  MujocoModel copy(mj_copyModel(nullptr, &model));
  if (!copy) throw NumericalFailure("mujoco: no memory for the model");
  return copy;
}

MujocoData make_data(const mjModel& model) {
  MujocoData data(mj_makeData(&model));
  if (!data) throw NumericalFailure("mujoco: no memory for the model's data");
  return data;
}

std::string take_mujoco_warnings() {
  return fmt::format("{}", fmt::join(std::exchange(warnings, {}), "; "));
}

}  // namespace twincraft
