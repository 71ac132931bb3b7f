// The resolution of one member, from what its engines recorded.
#pragma once

#include "runtime/linear/inspection.h"
#include "runtime/study/run.h"

namespace twincraft {

/// Sets the member's resolution and its engines' own energies, and says of an engine that stopped
/// what stopped it. Judged by the first engine that flew: both share motion, method and step.
void judge_member(const Model& model, const Inspection& inspection, Member& member);

}  // namespace twincraft
