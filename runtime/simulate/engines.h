// What makes the engines of a compiled model: one row for each.
#pragma once

#include <memory>
#include <string>

#include "compiler/ir/bundle.h"
#include "compiler/ir/engine_kind.h"
#include "runtime/bsm/kernel.h"
#include "runtime/engine/engine.h"

namespace twincraft {

/// @param instructions  of the analytic engine @throws NumericalFailure when it cannot be built
std::unique_ptr<Engine> make_engine(
    EngineKind kind, const Bundle& bundle,
    bsm::InstructionSet instructions = bsm::fastest_instruction_set(bsm::Use::kOne));

/// Why an engine cannot fly a model at all; empty when it can.
std::string refusal_of(EngineKind kind, const Model& model);

}  // namespace twincraft
