// See landings.h. Tested by tests/runtime/propagate_test.cpp.
#include "runtime/integrate/landings.h"

#include <utility>

namespace twincraft {

Landings::Landings(double step, double duration, std::vector<double> events)
    : step_(step), duration_(duration), events_(std::move(events)), done_(!(duration > 0.0)) {}

Landing Landings::next() {
  double multiple = static_cast<double>(index_) * step_;
  const bool is_last = multiple > duration_ - tolerance();
  if (is_last) multiple = duration_;
  if (event_ < events_.size() && events_[event_] < multiple + tolerance()) {
    const double event = events_[event_];
    const bool coincide = event > multiple - tolerance();
    // What changes at the very end no longer matters; the run ends at its duration.
    if (!(coincide && is_last)) {
      ++event_;
      if (coincide) ++index_;
      return {event, true};
    }
  }
  ++index_;
  done_ = is_last;
  return {multiple, false};
}

}  // namespace twincraft
