// Philox4x64-10, a counter-based generator of Salmon, Moraes, Dror and Shaw ("Parallel random
// numbers: as easy as 1, 2, 3", SC 2011): a keyed bijection of counters, so that any number of a
// sequence is had without those before it. Tested by tests/compiler/draws_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace twincraft::draws {

using Key = std::array<std::uint64_t, 2>;
using Block = std::array<std::uint64_t, 4>;

Block philox(Block counter, Key key);

/// The key of everything that is drawn by one seed for one name.
Key key_of(std::uint64_t seed, const std::string& name);

/// The 52 leading bits as a number in the open interval (0, 1), an odd multiple of 2^-53.
double unit_number(std::uint64_t bits);

}  // namespace twincraft::draws
