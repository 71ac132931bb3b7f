// What a loaded MuJoCo model holds, in the terms of the assembly: welded bodies and wheels are
// counted on the link that carries them. Tested by tests/runtime/proof_test.cpp.
#pragma once

#include <mujoco/mujoco.h>

#include "runtime/engine/held.h"
#include "runtime/mujoco/tree_map.h"

namespace twincraft {

HeldMachine held_by(const mjModel& loaded, const TreeMap& map);

}  // namespace twincraft
