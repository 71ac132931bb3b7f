// A member's samples once more, as if it were flown again.
#pragma once

#include <array>

#include "runtime/study/member.h"

namespace twincraft {

/// @param trajectories  of both engines, with all their samples and books
void replay(const Model& model, const std::array<const Trajectory*, 2>& trajectories,
            MemberWatch& watch);

}  // namespace twincraft
