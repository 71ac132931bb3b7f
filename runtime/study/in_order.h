// Independent pieces of work by several threads, with results handed over in order: what comes out
// does not depend on how many threads there are. Results that are early wait, but not without
// limit. Tested by tests/runtime/sweep_test.cpp.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace twincraft {

/// So many results per thread may be early.
inline constexpr std::size_t kEarlyResults = 4;

template <class Result>
struct OrderedWork {
  std::size_t count = 0;
  std::function<Result(std::size_t)> work;  // from several threads at once
  std::function<void(Result)> deliver;      // one call at a time, in the order of the work
  std::function<bool()> may_go_on;          // false: start no further piece
};

template <class Result>
class OrderedWorkers {
 public:
  OrderedWorkers(const OrderedWork<Result>& plan, std::size_t workers)
      : plan_(plan), window_(kEarlyResults * workers) {}

  void work() {
    std::unique_lock lock(mutex_);
    while (true) {
      room_.wait(lock, [this] { return next_ - delivered_ < window_ || failure_; });
      if (next_ == plan_.count || failure_ || !plan_.may_go_on()) return;
      const std::size_t index = next_++;
      lock.unlock();
      try {
        Result result = plan_.work(index);
        lock.lock();
        early_.emplace(index, std::move(result));
        deliver_what_is_due();
      } catch (...) {
        if (!lock.owns_lock()) lock.lock();
        failure_ = std::current_exception();
      }
      room_.notify_all();
    }
  }

  void rethrow_failure() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void deliver_what_is_due() {
    while (!early_.empty() && early_.begin()->first == delivered_) {
      plan_.deliver(std::move(early_.begin()->second));
      early_.erase(early_.begin());
      ++delivered_;
    }
  }

  const OrderedWork<Result>& plan_;
  const std::size_t window_;
  std::mutex mutex_;
  std::condition_variable room_;
  std::size_t next_ = 0;
  std::size_t delivered_ = 0;
  std::map<std::size_t, Result> early_;
  std::exception_ptr failure_;
};

/// Returns when all that was started is done; what a piece of work throws passes through.
/// @param jobs  threads, the caller's own among them; fewer where the machine gives no more
template <class Result>
void in_order(const OrderedWork<Result>& plan, int jobs) {
  OrderedWorkers<Result> workers(plan, static_cast<std::size_t>(jobs));
  {
    std::vector<std::jthread> others;
    try {
      for (int i = 1; i < jobs; ++i) others.emplace_back([&workers] { workers.work(); });
    } catch (const std::system_error&) {
      // Out of threads: slower, and the results are the same.
    }
    workers.work();
  }
  workers.rethrow_failure();
}

}  // namespace twincraft
