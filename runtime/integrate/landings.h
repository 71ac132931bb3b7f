// The instants a run always lands on, one after another: multiples of the step (computed as
// index * step, so nothing drifts), events, and the end. The last step is shortened when the step
// does not divide the duration.  Tested by tests/runtime/propagate_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

namespace twincraft {

struct Landing {
  double time = 0.0;      // [s]
  bool is_event = false;  // inputs change here
};

class Landings {
 public:
  /// @param events    sorted, without repeats, inside (0, duration) [s]
  /// @param duration  [s] infinite: there is no end
  /// @pre step > 0
  Landings(double step, double duration, std::vector<double> events);

  /// Instants closer than this [s] are one: a multiple of the step next to an event is the event.
  double tolerance() const { return 1.0e-9 * step_; }
  bool done() const { return next_.done; }
  Landing next();  // @pre not done()
  /// What next() would give.
  Landing peek() const;

  /// How far it is.
  struct Position {
    std::size_t event = 0;   // the next one
    std::int64_t index = 1;  // of the next multiple
    bool done = false;
  };
  const Position& position() const { return next_; }
  void go_on_from(const Position& position) { next_ = position; }
  /// The landing that comes next at a position, which goes past it. @pre not done there
  Landing follow(Position& at) const;

 private:
  double step_;
  double duration_;
  std::vector<double> events_;
  Position next_;
};

}  // namespace twincraft
