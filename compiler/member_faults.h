// What is wrong with one member of a study beyond what is wrong with the spec: told once, at the
// values that made the member. Tested by tests/malformed.
#pragma once

#include <cstddef>
#include <vector>

#include "compiler/diag/diagnostics.h"
#include "compiler/syntax/overrides.h"

namespace twincraft {

/// Adds the faults of member `index` that are not known yet. Notes are none.
/// @param changes  that made the member
void take_new_faults(const Diagnostics& of_member, std::size_t index,
                     const std::vector<Override>& changes, Diagnostics& diagnostics);

}  // namespace twincraft
