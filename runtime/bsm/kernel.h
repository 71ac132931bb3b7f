// The inside of a step, behind an interface: built from a plan for an instruction set of this
// processor. Same program, same processor features: the same bytes come out; another instruction
// set may fuse a product and a sum into one rounding, so its last digits differ.
// Tested by tests/runtime/kernel_test.cpp.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "runtime/bsm/plan.h"
#include "runtime/bsm/processor.h"
#include "runtime/engine/observation.h"

namespace twincraft::bsm {

class Kernel {
 public:
  virtual ~Kernel() = default;

  /// How many spacecraft the state holds side by side: entry i of spacecraft l is at i * lanes + l.
  virtual std::size_t lanes() const = 0;

  /// Hold these inputs from now on, one per lane. They may change or go afterwards.
  virtual void hold(std::span<const HeldInputs* const> held) = 0;
  /// rate = d(state)/dt at `time` [s], laid out as runtime/engine/state.h says. Tanks are as full
  /// as they are then, under the flows that are held.
  virtual void derivative(double time, const double* state, double* rate) = 0;
  /// The same, and what changes the books: one `books` per lane, set by settle_books() or sooner,
  /// for several are made at once. They stay where they are until then.
  virtual void derivative_to_book(double time, const double* state, double* rate,
                                  BookRates* books) = 0;
  /// Before the next hold().
  virtual void settle_books() = 0;
  /// MRP shadow switch or quaternion normalisation, in place.
  virtual void finish_step(double* state) const = 0;
  /// The hub's equation [A B; C D] (a, omegaDot) = (vT, vR) of the last derivative() of lane 0, as
  /// printed in the back-substitution papers: 6x6 by rows, then the right-hand side.
  virtual void hub_equation(std::span<double, 42> equation) const = 0;
};

/// One spacecraft. @pre the processor has `set`, and the plan outlives the kernel
std::unique_ptr<Kernel> make_kernel(const Plan& plan,
                                    InstructionSet set = fastest_instruction_set(Use::kOne));

/// How many spacecraft a batch steps at once.
std::size_t batch_lanes(InstructionSet set);
/// As many spacecraft of one structure as there are lanes; their constants may differ. The plans
/// outlive the kernel.
std::unique_ptr<Kernel> make_batch_kernel(std::span<const Plan* const> plans, InstructionSet set);

}  // namespace twincraft::bsm
