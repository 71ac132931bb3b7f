// The samples of two engines brought together while both are flown: what compares them sees each
// pair once, in order, and nothing is kept that has met its partner.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <functional>
#include <utility>

#include "runtime/engine/observation.h"

namespace twincraft {

class Pairing {
 public:
  using Take = std::function<void(const Observation& a, const Observation& b)>;

  explicit Pairing(Take take) : take_(std::move(take)) {}

  /// The next sample of engine 0 or 1.
  void add(std::size_t engine, Observation sample);
  /// No more will come of it, so those of the other have no partner.
  void end(std::size_t engine);

  /// Both were sampled at the same instants throughout. @pre both have ended
  bool same_times() const { return pairs_ > 0 && pairs_ == added_[0] && pairs_ == added_[1]; }
  std::size_t pairs() const { return pairs_; }

 private:
  void deliver();

  Take take_;
  std::array<std::deque<Observation>, 2> waiting_;
  std::array<std::size_t, 2> added_{};
  std::size_t pairs_ = 0;
  bool over_ = false;  // two samples differ in time, or one engine has no more
};

}  // namespace twincraft
