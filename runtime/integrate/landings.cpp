// See landings.h. Tested by tests/runtime/propagate_test.cpp.
#include "runtime/integrate/landings.h"

#include <utility>

namespace twincraft {

Landings::Landings(double step, double duration, std::vector<double> events)
    : step_(step), duration_(duration), events_(std::move(events)) {
  next_.done = !(duration > 0.0);
}

Landing Landings::peek() const {
  Position after = next_;
  return follow(after);
}

Landing Landings::next() { return follow(next_); }

Landing Landings::follow(Position& at) const {
  double multiple = static_cast<double>(at.index) * step_;
  const bool is_last = multiple > duration_ - tolerance();
  if (is_last) multiple = duration_;
  if (at.event < events_.size() && events_[at.event] < multiple + tolerance()) {
    const double event = events_[at.event];
    const bool coincide = event > multiple - tolerance();
    // What changes at the very end no longer matters; the run ends at its duration.
    if (!(coincide && is_last)) {
      ++at.event;
      if (coincide) ++at.index;
      return {event, true};
    }
  }
  ++at.index;
  at.done = is_last;
  return {multiple, false};
}

}  // namespace twincraft
