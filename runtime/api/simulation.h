// One engine of a compiled model on its way, driven from outside: what the C interface hands out.
// It stands at the end of a step, and still does so after a fault.
// Tested by tests/api/simulation_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compiler/ir/engine_kind.h"
#include "runtime/api/compiled_model.h"
#include "runtime/bsm/kernel.h"
#include "runtime/simulate/flight.h"

namespace twincraft::api {

/// Asked at step ends now and then; true: end with TC_INTERRUPTED.
using Poll = std::function<bool()>;

/// What happens at every tick of run_until().
struct Control {
  double every = 0.0;                             // [s]; 0: every step end
  std::function<bool(double time)> stop = {};     // true: enough
  std::function<void(double time)> control = {};  // sets inputs; the end left out
};

class Simulation {
 public:
  /// At t = 0. @throws Fault: the engine cannot fly this model
  Simulation(std::shared_ptr<const CompiledModel> model, EngineKind engine);
  /// Another one that goes on from the same instant to the same bytes.
  std::unique_ptr<Simulation> copy() const;

  const CompiledModel& model() const { return *model_; }
  EngineKind engine() const { return kind_; }
  double time() const { return flight_->time(); }
  double next_landing() const { return flight_->next_landing(); }
  std::int64_t grid_point() const { return flight_->next_grid_point(); }
  double tolerance() const { return flight_->tolerance(); }

  /// As it is now; stays until it moves.
  const Observation& observe();
  /// @pre sizes fit, here and below
  void read_state(std::span<double> numbers) {
    read_signals(model_->state_signals(), observe(), numbers);
  }
  void read_outputs(std::span<double> numbers) {
    read_signals(model_->output_signals(), observe(), numbers);
  }
  void read_inputs(std::span<double> numbers) const;
  void set_state(std::span<const double> numbers);

  /// Drive inputs from `first` on, all or none. @throws Fault: one is not finite
  void drive(std::size_t first, std::span<const double> values);
  void release(std::size_t input);
  double input(std::size_t input) const { return flight_->input(input); }
  bool is_driven(std::size_t input) const { return flight_->is_driven(input); }

  /// To the `count`-th next point of the grid. @throws NumericalFailure; it stands at the last good
  /// step end, then as in the others
  void step(std::size_t count, const Poll& poll = {});
  /// To the next point of the grid without a motion, see Flight.
  void pass();
  /// To exactly `time`. @throws Fault: in the past, or not finite
  void advance_to(double time, const Poll& poll = {});

  /// All that the motion from here on depends on, sealed.
  std::string snapshot() const;
  /// @throws Fault: of another vehicle, engine or version, or damaged
  void restore(std::string_view bytes);
  void reset();
  /// The same unsealed, for the same simulation.
  Flight::Snapshot position() const { return flight_->snapshot(); }
  void go_on_from(const Flight::Snapshot& snapshot);

 private:
  Simulation(std::shared_ptr<const CompiledModel> model, EngineKind kind,
             std::unique_ptr<Engine> engine);

  std::shared_ptr<const CompiledModel> model_;
  EngineKind kind_;
  std::unique_ptr<Engine> engine_;
  std::unique_ptr<Flight> flight_;
  Flight::Snapshot start_;
  Observation seen_;
  bool has_seen_ = false;
};

/// @throws Fault(TC_INTERRUPTED) when `poll` says so
void ask(const Poll& poll);

/// Refuses a time that `now` is past, or that is none.
void check_target(double time, double now, double tolerance);

/// Fly `advance_to` from tick to tick up to `time`, asking in between. It serves whatever has
/// time(), advance_to(), next_landing() and tolerance().
template <class Flyer>
void run_until(Flyer& flyer, double time, const Control& control, const Poll& poll) {
  check_target(time, flyer.time(), flyer.tolerance());
  const double start = flyer.time();
  for (double tick = 1.0; flyer.time() < time - flyer.tolerance(); tick += 1.0) {
    if (control.stop && control.stop(flyer.time())) return;
    if (control.control) control.control(flyer.time());
    const double next = control.every > 0.0 ? start + tick * control.every : flyer.next_landing();
    flyer.advance_to(next < time - flyer.tolerance() ? next : time, poll);
  }
  if (control.stop) control.stop(flyer.time());
}

}  // namespace twincraft::api
