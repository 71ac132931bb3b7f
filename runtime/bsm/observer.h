// What the analytic engine reports of itself: mass, momenta and energies, once per sample, behind
// an interface like the kernel's and built for an instruction set. It shares nothing with a step
// but constants. Tested by tests/runtime/observer_test.cpp.
#pragma once

#include <memory>
#include <span>

#include "compiler/ir/assembly.h"
#include "runtime/bsm/plan.h"
#include "runtime/bsm/processor.h"
#include "runtime/engine/observation.h"

namespace twincraft::bsm {

class Observer {
 public:
  virtual ~Observer() = default;

  /// Set all of `seen` that is a sum over mass elements, rotors and springs.
  /// @param state   laid out as runtime/engine/state.h says
  /// @param shares  of every tank: what is left, as a part of what it held at t = 0
  virtual void observe(const double* state, std::span<const double> shares, Observation& seen) = 0;
};

/// @pre the processor has `set`
std::unique_ptr<Observer> make_observer(const Plan& plan, const Assembly& assembly,
                                        InstructionSet set);

}  // namespace twincraft::bsm
