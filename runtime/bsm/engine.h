// The analytic engine: back-substitution as a recursion over the tree. See law.h for the
// equations. Tested by tests/runtime/bsm_test.cpp and the component battery.
#pragma once

#include <memory>

#include "runtime/bsm/kernel.h"
#include "runtime/engine/engine.h"

namespace twincraft {

std::unique_ptr<Engine> make_bsm_engine(
    const Model& model, bsm::InstructionSet set = bsm::fastest_instruction_set(bsm::Use::kOne));

}  // namespace twincraft
