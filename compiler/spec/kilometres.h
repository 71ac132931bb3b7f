// Orbits written in kilometres without saying so. What is plain in metres and absurd there, and
// sound in kilometres, gets a warning. Tested by tests/compiler/initial_test.cpp.
#pragma once

#include "compiler/spec/environment.h"
#include "compiler/spec/initial.h"

namespace twincraft {

/// @pre the orbit, if there is one, is bound
void warn_of_kilometres(const InitialSpec& initial, const GravitySpec& gravity,
                        Diagnostics& diagnostics);

}  // namespace twincraft
