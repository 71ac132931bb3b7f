// What a harness demands of the code beyond not crashing.
#pragma once

#include <cstdlib>

namespace twincraft::fuzz {

/// Ends the process when the claim does not hold, in release builds too; libFuzzer keeps the input.
inline void claim(bool holds) {
  if (!holds) std::abort();
}

}  // namespace twincraft::fuzz
