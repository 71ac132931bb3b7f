// The one interface of both engines: (t, state) to a derivative. An engine is built from a compiled
// model and owns all its workspace; a derivative never allocates.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "compiler/ir/engine_kind.h"
#include "compiler/ir/inputs.h"
#include "runtime/engine/held.h"
#include "runtime/engine/observation.h"
#include "runtime/engine/state.h"

namespace twincraft {

/// An engine can not go on: a non-finite state, an engine's own error. Says which coordinate.
struct NumericalFailure : std::runtime_error {
  explicit NumericalFailure(const std::string& what, std::string where = {})
      : std::runtime_error(what), coordinate(std::move(where)) {}
  std::string coordinate;  // a state's name; empty: of none
};

class Engine {
 public:
  virtual ~Engine() = default;

  virtual std::string_view name() const = 0;  // the key of its EngineName
  virtual const StateLayout& layout() const = 0;

  /// A second engine of the same model, as newly built: its workspace is its own, and what never
  /// changes is shared. Each may be used on a thread of its own.
  virtual std::unique_ptr<Engine> another() const = 0;

  /// Whether its numbers may be summed with AVX2: this processor has it, and the engine is not
  /// asked to do with less.
  virtual bool may_use_avx2() const { return false; }

  /// The state of the model at t = 0.
  virtual Eigen::VectorXd initial_state() const = 0;

  /// Everything that acts by schedule, from now on until the next call: at t = 0 and at every
  /// event. An engine is built with the inputs of t = 0.
  virtual void hold(const Inputs& inputs) = 0;

  /// rate = d(state)/dt at `time`. Both have layout().size() entries and do not overlap. Leaves
  /// nothing that a later call can see.
  /// @param books  receives what changes them, where given; the rate is the same either way
  virtual void derivative(double time, std::span<const double> state, std::span<double> rate,
                          BookRates* books) = 0;
  void derivative(double time, std::span<const double> state, std::span<double> rate) {
    derivative(time, state, rate, nullptr);
  }

  /// The same for several at once: settle_books() sets all `books` that were asked for since it was
  /// last called. @pre they stay where they are until then, and it comes before the next hold()
  virtual void derivative_to_book(double time, std::span<const double> state,
                                  std::span<double> rate, BookRates& books) {
    derivative(time, state, rate, &books);
  }
  virtual void settle_books() {}

  /// After an accepted step: MRP shadow switch or quaternion normalisation, in place.
  virtual void finish_step(std::span<double> state) = 0;

  /// Sets all of `seen`. Takes nothing from the heap when it has been used before.
  virtual void observe(double time, std::span<const double> state, Observation& seen) = 0;
  Observation observe(double time, std::span<const double> state) {
    Observation seen;
    observe(time, state, seen);
    return seen;
  }
  /// The same for several at once: sum_up_noted() sets all of what was noted since it was last
  /// called. @pre `seen` stays where it is until then; fewer than summed_at_once() wait
  virtual void note(double time, std::span<const double> state, Observation& seen) {
    observe(time, state, seen);
  }
  virtual void sum_up_noted() {}
  virtual std::size_t summed_at_once() const { return 1; }

  /// The mass matrix over (v_B in N, omega in B, joint rates, wheel rates) when what is held began,
  /// for proofs.
  virtual Eigen::MatrixXd mass_matrix(std::span<const double> state) = 0;

  /// The numbers it was built of. Nothing: its mass matrix tells them all, as that of a point mass.
  virtual HeldMachine held() const { return {}; }

  /// How large the terms are of which it forms mass matrix and forces at `state`, when the inputs
  /// that are held began.
  virtual RoundingTerms rounding_terms(std::span<const double> /*state*/) { return {}; }
};

}  // namespace twincraft
