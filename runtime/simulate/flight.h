// One engine on its way: from landing to landing of its plan, or exactly to a time between them,
// with inputs that follow their schedules or are driven. Everything that moves an engine is built
// on it.  Tested by tests/runtime/flight_test.cpp.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compiler/ir/inputs.h"
#include "runtime/engine/engine.h"
#include "runtime/integrate/landings.h"
#include "runtime/integrate/step_control.h"

namespace twincraft {

/// What the outside did to the vehicle since t = 0, integrated beside the state.
struct Books {
  double work = 0.0;                              // [J]
  Vector3d impulse_N = Vector3d::Zero();          // [N s]
  Vector3d angular_impulse_N = Vector3d::Zero();  // [N m s] about C
  double own_work = 0.0;                          // [J] on the motion about C
};

struct FlightOptions {
  bool keeps_books = false;
  bool has_end = true;      // at the plan's duration, else never
  bool steps_back = false;  // stands at the last good step end after a failure
};

class Flight {
 public:
  /// At t = 0. All that is referred to must outlive it. @pre step and duration are positive
  Flight(Engine& engine, const Model& model, FlightOptions options = {});
  ~Flight();
  Flight(const Flight&) = delete;
  Flight& operator=(const Flight&) = delete;

  bool done() const { return landings_.done(); }
  double time() const { return time_; }                       // [s]
  double tolerance() const { return landings_.tolerance(); }  // [s] closer instants are one
  std::span<const double> state() const {                     // of the engine
    return {stepper_.solution().value.data(), static_cast<std::size_t>(size_)};
  }
  Books books() const;  // zeros unless they are kept
  const StepCounts& counts() const { return counts_; }
  const AcceptedErrors& accepted() const { return accepted_; }

  /// To the next landing or to where a tank runs empty before it (a failure where slosh drains with
  /// the tank and would have no mass left), or as far as an adaptive method
  /// got when `*stop` became true.
  /// @throws NumericalFailure; the engine is then beyond its last good step unless it steps back.
  /// @pre not done()
  void advance(const std::atomic<bool>* stop = nullptr);

  /// To exactly `time` [s], which splits a step unless it is a landing, or to the end where that
  /// comes first. Pieces that end on landings give the bytes of one run. A time that is over, or
  /// closer than tolerance(), is where it is.
  /// @throws NumericalFailure
  void advance_to(double time);

  /// To the next point of the grid k * step, event by event. @pre not done()
  void advance_on_grid();
  /// The same of a vehicle whose motion has failed: time, schedules and tanks go on, its state
  /// stays.
  void pass_on_grid();
  std::int64_t next_grid_point() const { return landings_.position().index; }
  double next_landing() const { return landings_.peek().time; }  // [s] @pre not done()

  /// Go on from another state of the engine; what rounding left over of earlier steps is dropped.
  void restart(std::span<const double> state) { stepper_.restart(state); }

  /// The inputs as they act now.
  const Inputs& inputs() const { return feed_.inputs(); }
  /// Hold a port at a value from now on, in place of its schedule. @param port  of ports_of(model)
  void drive(std::size_t port, double value);
  /// Give it back to its schedule.
  void release(std::size_t port);
  /// What acts at a port.
  double input(std::size_t port) const { return feed_.value(port); }
  bool is_driven(std::size_t port) const { return feed_.is_driven(port); }

  /// Everything that the motion from here on depends on: a flight of the same model and engine goes
  /// on from it to the bit.
  struct Snapshot {
    double time = 0.0;
    RungeKutta::Solution solution;
    Landings::Position landing;
    InputFeed::Position inputs;
    StepCounts counts;
    AcceptedErrors accepted;
  };
  Snapshot snapshot() const;
  void restore(const Snapshot& snapshot);

 private:
  class BookkeepingOde;
  class ExcusingOde;

  void hold(const Inputs& inputs);
  /// To where a tank runs empty, and stop what draws from it.
  void fly_until_empty(const std::atomic<bool>* stop);
  void step_to(double time, const std::atomic<bool>* stop);
  /// What is not a plain step of an engine that may end beyond its last good one.
  void step_carefully(double time, const std::atomic<bool>* stop);
  void step_once(double time);
  void step_adaptively(double to, const std::atomic<bool>* stop);
  [[noreturn]] void fail() const;

  Engine& engine_;
  int size_;  // of its state
  std::unique_ptr<Ode> ode_;
  std::unique_ptr<ExcusingOde> excusing_;  // of an adaptive method
  RungeKutta stepper_;
  std::vector<std::string> names_;
  StepControl control_;
  Landings landings_;
  InputFeed feed_;
  std::optional<RungeKutta::Solution> last_good_;  // of a flight that steps back
  std::vector<std::string> tank_names_;
  std::vector<std::string> emptied_slosh_;  // of each tank: what has no mass when it is empty
  bool is_careful_ = false;                 // its steps are more than steps
  double time_ = 0.0;
  double empty_at_ = 0.0;  // [s] when the first tank runs empty; infinite: none does
  StepCounts counts_;
  AcceptedErrors accepted_;
};

}  // namespace twincraft
