// Do the two halves describe one machine? The compiler asks before it emits either. Names, counts
// and springs must match exactly; mass, centre of mass, inertia and all couplings are compared as
// the mass matrices of both halves at the initial and at seeded random configurations. A failure is
// a bug of the compiler, never a fault of the user.
// Tested by tests/compiler/verify_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "compiler/ir/model.h"

namespace twincraft {

/// Whether the numbers can be computed with at all: lengths and masses far beyond any vehicle let
/// the mass matrix or the initial state overflow, and then nothing can be compared.
bool is_finite(const Model& model);

/// What differs, one text each; empty when the halves are one machine. Token wheel masses that are
/// added on top (`compensate: false`) are a declared difference and no failure.
std::vector<std::string> verify(const Model& model);

}  // namespace twincraft
