// The derivative of the analytic engine as a list of operations: the kernel's own text, run once
// over numbers that write down what is done to them (runtime/scalar/recorder.h). What a model fixes
// is constant there; all that an engine is given is an input. Which way the text takes depends on
// the model alone, so one tape is good for every state and every schedule.
#pragma once

#include <span>

#include "compiler/ir/inputs.h"
#include "compiler/ir/model.h"
#include "runtime/scalar/tape.h"

namespace twincraft::bsm {

/// Where the inputs of the tape are. Its outputs are the rate of the state.
struct RecordedInputs {
  std::size_t states = 0, inputs = 0, tanks = 0;

  explicit RecordedInputs(const Model& model);
  static constexpr std::size_t time() { return 0; }
  std::size_t state(std::size_t i) const { return 1 + i; }
  std::size_t u(std::size_t i) const { return 1 + states + i; }
  std::size_t since() const { return u(inputs); }
  /// Four numbers: full, spent, since and flow of a Drain.
  std::size_t tank(std::size_t i) const { return since() + 1 + 4 * i; }
  std::size_t size() const { return tank(tanks); }

  /// Of `in`, what is held.
  void put(const Inputs& held, std::span<double> in) const;
};

Tape recorded_derivative(const Model& model);

}  // namespace twincraft::bsm
