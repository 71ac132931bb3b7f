// What the analytic engine reports of itself: mass, momenta and energies, once per sample, behind
// an interface like the kernel's and built for an instruction set. It shares nothing with a step
// but constants, and takes a few samples at once. Tested by tests/runtime/observer_test.cpp.
#pragma once

#include <memory>
#include <span>

#include "compiler/ir/assembly.h"
#include "runtime/bsm/plan.h"
#include "runtime/bsm/processor.h"
#include "runtime/engine/observation.h"

namespace twincraft::bsm {

/// A state, and who is to be told what it comes to.
struct Noted {
  const double* state;   // laid out as runtime/engine/state.h says
  const double* shares;  // of every tank: what is left, as a part of what it held at t = 0
  Observation* seen;
};

class Observer {
 public:
  virtual ~Observer() = default;

  /// How many states are summed up at once.
  virtual std::size_t lanes() const = 0;

  /// Set all of `seen` but the time. What comes of a state depends on no other.
  /// @pre there are 1 to lanes() of them
  virtual void observe(std::span<const Noted> noted) = 0;
};

/// @pre the processor has `set`
std::unique_ptr<Observer> make_observer(const Plan& plan, const Assembly& assembly,
                                        InstructionSet set);

}  // namespace twincraft::bsm
