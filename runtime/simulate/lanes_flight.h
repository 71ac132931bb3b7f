// As many spacecraft as an instruction holds, side by side on their way by a method of fixed steps:
// what Flight is for one. They are of one structure, nothing of them drains, and none flies
// otherwise for what the others are.
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

  /// One spacecraft, and the plan made of it. Both must outlive what flies them.
  struct Craft {
    const Model* model = nullptr;
    const bsm::Plan* plan = nullptr;
  };
  /// Whether they may fly side by side: alike, and landing at the same instants.
  /// @pre no refusal() of either
  static bool fit(const Craft& a, const Craft& b);

  struct Options {
    bool has_end = false;  // at the duration, which all have, else never
    bsm::InstructionSet instructions = bsm::fastest_instruction_set(bsm::Use::kBatch);
  };
  /// All at t = 0. The last one repeats in the lanes that are left.
  /// @pre 1 to as many of them as `instructions` have lanes; each fits the first
  explicit LanesFlight(std::span<const Craft> crafts) : LanesFlight(crafts, Options{}) {}
  LanesFlight(std::span<const Craft> crafts, Options options);
  ~LanesFlight();
  LanesFlight(const LanesFlight&) = delete;
  LanesFlight& operator=(const LanesFlight&) = delete;

  /// By default.
  static std::size_t lanes();

  double time() const { return time_; }                       // [s]
  double tolerance() const { return landings_.tolerance(); }  // [s] closer instants are one
  bool done() const { return landings_.done(); }
  /// To the next landing. @pre not done(), here and below
  void advance();
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

  const Model& model(std::size_t lane) const { return *crafts_[lane].model; }

  std::vector<Craft> crafts_;  // of each lane
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
