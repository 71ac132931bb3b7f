// Samples that wait for one another, because an engine sums up several at once for little more than
// one. Whoever takes them gets them in the order in which they came, a few at a time.
// Tested by tests/runtime/waiting_samples_test.cpp.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "runtime/engine/engine.h"

namespace twincraft {

/// @tparam Beside  what waits with each of them, such as books
template <class Beside>
class WaitingSamples {
 public:
  struct Sample {
    /// With all the room that it will ever need: a step takes nothing from the heap.
    explicit Sample(const StateLayout& layout) {
      seen.joint_position.resize(static_cast<std::size_t>(layout.joints));
      seen.joint_rate.resize(static_cast<std::size_t>(layout.joints));
      seen.wheel_rate.resize(static_cast<std::size_t>(layout.wheels));
    }
    Observation seen;
    Beside beside = {};
  };

  /// `engine` must outlive it.
  explicit WaitingSamples(Engine& engine) : engine_(engine) {
    for (std::size_t i = 0; i <= engine.summed_at_once(); ++i)
      samples_.push_back(std::make_unique<Sample>(engine.layout()));
  }

  /// @pre not is_full()
  void add(double time, std::span<const double> state, const Beside& beside) {
    Sample& sample = *samples_[count_++];
    engine_.note(time, state, sample.seen);
    sample.beside = beside;
  }

  /// There are as many as the engine sums up at once: deliver() before the next.
  bool is_full() const { return count_ + 1 == samples_.size(); }

  /// All that wait, one after another, to take(seen, beside). Where that says false, it gets none
  /// of those that follow.
  template <class Take>
  void deliver(const Take& take) {
    engine_.sum_up_noted();
    std::size_t taken = 0;
    for (bool goes_on = true; goes_on && taken < count_; ++taken)
      goes_on = take(samples_[taken]->seen, samples_[taken]->beside);
    if (taken > 0) std::swap(samples_.back(), samples_[taken - 1]);
    count_ = 0;
  }

  /// The last that was taken. Zeros: none was.
  const Sample& last() const { return *samples_.back(); }

 private:
  Engine& engine_;
  std::vector<std::unique_ptr<Sample>> samples_;  // as many as may wait, and the last taken
  std::size_t count_ = 0;                         // that wait
};

}  // namespace twincraft
