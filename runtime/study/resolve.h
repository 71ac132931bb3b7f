// The resolution of one member, from what its engines recorded.
#pragma once

#include <span>

#include "runtime/linear/inspection.h"
#include "runtime/linear/motion_record.h"
#include "runtime/study/member.h"

namespace twincraft {

/// Sets the member's resolution and its engines' own energies, and says of an engine that stopped
/// what stopped it. Judged by the first engine that flew: both share motion, method and step.
/// @param records  of the member's engines, in their order
void judge_member(const Model& model, const Inspection& inspection,
                  std::span<const MotionRecord* const> records, Member& member);

}  // namespace twincraft
