// A flight's snapshot as bytes for another process: they say of which vehicle, engine, program and
// instruction set they are, and a sum over them tells damage. Numbers are the machine's own, little
// endian. Tested by tests/api/snapshot_test.cpp.
#pragma once

#include <string>
#include <string_view>

#include "compiler/ir/engine_kind.h"
#include "runtime/api/compiled_model.h"
#include "runtime/simulate/flight.h"

namespace twincraft::api {

std::string seal(const Flight::Snapshot& snapshot, const CompiledModel& model, EngineKind engine);

/// @param like  of the same model and engine: what sizes must be
/// @throws Fault(TC_SNAPSHOT): of something else, or damaged
Flight::Snapshot unseal(std::string_view bytes, const CompiledModel& model, EngineKind engine,
                        const Flight::Snapshot& like);

}  // namespace twincraft::api
