// Counts what the program takes from the heap, so that a test can claim a loop takes nothing.
// Linking allocation_counter.cpp replaces the global operator new.
#pragma once

#include <cstddef>

namespace twincraft::test {

/// Calls of operator new and counted_malloc since the program began.
long allocation_count();

/// malloc, counted: a hook for C libraries that let theirs be replaced.
void* counted_malloc(std::size_t size);

}  // namespace twincraft::test
