// Were two engines built of the same numbers? Link by link: mass, centre of mass, inertia, joint,
// spring; wheel by wheel. A difference that a mass matrix hides, because the body is tiny or far
// away, shows here. Tested by tests/runtime/proof_test.cpp.
#pragma once

#include <vector>

#include "compiler/ir/assembly.h"
#include "runtime/compare/proof.h"

namespace twincraft {

/// One line per kind of number, with the worst link or wheel; none when an engine holds nothing.
std::vector<ProofLine> compare_held(const Assembly& assembly, const HeldMachine& a,
                                    const HeldMachine& b);

}  // namespace twincraft
