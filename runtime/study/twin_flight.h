// Both engines of a member through its plan, in alternate slices of time: they stay together, so
// that their samples are compared as they come and an early end leaves a stretch that both have
// flown. Nothing here grows with the number of samples, unless they are to be kept.
#pragma once

#include <memory>
#include <string_view>

#include "runtime/study/member.h"

namespace twincraft {

/// Fills in the member's engines, comparison and references. Numerical failures are part of them.
void fly_both(const Bundle& bundle, const RunOptions& options, MemberWatch* watch, Member& member);

}  // namespace twincraft
