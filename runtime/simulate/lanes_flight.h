// As many spacecraft of one model as an instruction holds, side by side on their way by a method of
// fixed steps: what Flight is for one. Nothing of them drains.
// Tested by tests/api/batch_test.cpp.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compiler/ir/inputs.h"
#include "runtime/bsm/kernel.h"
#include "runtime/engine/state.h"
#include "runtime/integrate/landings.h"
#include "runtime/integrate/runge_kutta.h"

namespace twincraft {

class LanesFlight {
 public:
  /// Why they have to be flown one by one; empty: they need not.
  static std::string refusal(const Model& model);

  /// All at t = 0. `model` must outlive it. @param plan  made of it @pre no refusal()
  LanesFlight(const Model& model, const bsm::Plan& plan);
  ~LanesFlight();
  LanesFlight(const LanesFlight&) = delete;
  LanesFlight& operator=(const LanesFlight&) = delete;

  static std::size_t lanes();

  double time() const { return time_; }  // [s]
  /// To the next point of the grid k * step, event by event.
  void advance_on_grid();

  /// Of one spacecraft, laid out as an engine's.
  void read_state(std::size_t lane, std::span<double> state) const;
  void set_state(std::size_t lane, std::span<const double> state);
  /// Why a spacecraft's motion has ended; empty: it has not. Its state is not finite any more.
  const std::string& failure(std::size_t lane) const { return failures_[lane]; }

  /// Several calls may come before hold().
  void drive(std::size_t lane, std::size_t port, double value);
  void release(std::size_t lane, std::size_t port);
  /// Let what was driven and released act.
  void hold();
  double input(std::size_t lane, std::size_t port) const { return feeds_[lane].value(port); }

 private:
  class LanesOde;

  void find_failures();

  const Model& model_;
  StateLayout layout_;
  std::vector<InputFeed> feeds_;  // of each lane
  std::vector<bsm::HeldInputs> held_;
  std::unique_ptr<bsm::Kernel> kernel_;
  std::unique_ptr<LanesOde> ode_;
  RungeKutta stepper_;
  Landings landings_;
  double time_ = 0.0;
  std::vector<std::string> failures_;
};

}  // namespace twincraft
