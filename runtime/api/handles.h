// What every handle of the C interface has, and the way through which every call of it goes: who
// uses it, what went wrong last, and no exception gets out.
#pragma once

#include <atomic>
#include <new>
#include <string>

#include "compiler/pipeline.h"
#include "runtime/api/faults.h"
#include "runtime/api/simulation.h"
#include "runtime/engine/engine.h"

namespace twincraft::api {

/// Which thread is inside a handle. The same one may come again from a callback, to ask and to
/// drive, but not to move.
class Lock {
 public:
  enum class Entry { kFirst, kAgain, kRefused };
  Entry enter() {
    const void* nobody = nullptr;
    if (owner_.compare_exchange_strong(nobody, me(), std::memory_order_acquire))
      return Entry::kFirst;
    return nobody == me() ? Entry::kAgain : Entry::kRefused;
  }
  void leave() { owner_.store(nullptr, std::memory_order_release); }

 private:
  static const void* me() {
    static thread_local const char here = 0;
    return &here;
  }
  std::atomic<const void*> owner_ = nullptr;
};

struct HandleParts {
  Lock own;
  Lock* lock = &own;
  std::string error;
  double failed_at = 0.0;
  std::string failed_coordinate;
  tc_poll poll = nullptr;
  void* poll_context = nullptr;

  Poll polled() const {
    if (poll == nullptr) return {};
    return [this] { return poll(poll_context) != 0; };
  }
};

/// Run `body`; what it throws becomes a status and a text.
template <class Body>
tc_status attempt(std::string& error, const Body& body) noexcept {
  const auto say = [&error](tc_status status, const char* what) noexcept {
    try {
      error = what;
    } catch (...) {
      error.clear();
    }
    return status;
  };
  try {
    body();
    return TC_OK;
  } catch (const Fault& fault) {
    return say(fault.status(), fault.what());
  } catch (const NumericalFailure& failure) {
    return say(TC_NUMERICAL, failure.what());
  } catch (const std::bad_alloc&) {
    return say(TC_MEMORY, "out of memory");
  } catch (const std::exception& exception) {
    return say(TC_INTERNAL, exception.what());
  } catch (...) {
    return say(TC_INTERNAL, "unknown exception");
  }
}

enum class Use { kAsks, kMoves };

/// The same inside a handle. @param handle  has HandleParts as `parts`, and is_whole()
template <class Handle, class Body>
tc_status inside(Handle* handle, Use use, const Body& body) noexcept {
  if (handle == nullptr || !handle->is_whole()) return TC_USAGE;
  HandleParts& parts = handle->parts;
  const Lock::Entry entry = parts.lock->enter();
  if (entry == Lock::Entry::kRefused) return TC_BUSY;
  const tc_status status = attempt(parts.error, [&] {
    if (use == Use::kMoves && entry == Lock::Entry::kAgain)
      refuse("it is on its way already: a callback may ask and drive, not move");
    body();
  });
  if (entry == Lock::Entry::kFirst) parts.lock->leave();
  return status;
}

/// A number where there is no status: NaN when another thread is inside.
template <class Handle, class Body>
double number_inside(const Handle* handle, const Body& body) noexcept {
  double number = std::numeric_limits<double>::quiet_NaN();
  inside(const_cast<Handle*>(handle), Use::kAsks, [&] { number = body(); });
  return number;
}

/// @throws Fault unless `count` is `wanted`
void check_size(std::size_t count, std::size_t wanted, const char* what);

/// `body` moves `flyer`, whose failure is kept.
template <class Handle, class Flyer, class Body>
void moving(Handle* handle, Flyer& flyer, const Body& body) {
  try {
    body();
  } catch (const NumericalFailure& failure) {
    handle->parts.failed_at = flyer.time();
    handle->parts.failed_coordinate = failure.coordinate;
    throw;
  }
}

/// A C control that asks `flyer`'s outputs through `seen` and drives it through `driven`.
Control control_of(const tc_control* from, Simulation& seen,
                   std::function<void(std::size_t, double)> drive);

/// A number with the unit of an input, or without: SI. @throws Fault
double read_input(const CompiledModel& model, std::size_t input, const char* text);
/// @throws Fault unless there is such an input
void check_input(const CompiledModel& model, std::size_t input, std::size_t count);

/// Copies `bytes` where there is room, and says how much is needed.
void hand_over(const std::string& bytes, void* to, std::size_t capacity, std::size_t* size);

}  // namespace twincraft::api

/// Texts are kept for those who ask.
struct tc_model {
  std::shared_ptr<const twincraft::api::CompiledModel> model;
  twincraft::api::HandleParts parts;
  std::string diagnostics;

  bool is_whole() const { return model != nullptr; }
};

struct tc_simulation {
  std::unique_ptr<twincraft::api::Simulation> owned;
  twincraft::api::Simulation* simulation = nullptr;  // a twin's is not owned
  twincraft::api::HandleParts parts;

  bool is_whole() const { return simulation != nullptr; }
  bool is_borrowed() const { return owned == nullptr; }
};
