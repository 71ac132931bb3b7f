// See allocation_counter.h. A file of its own, so that the compiler does not see new and free meet.
#include "tests/support/allocation_counter.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace twincraft::test {
namespace {
std::atomic<long> count = 0;
}

long allocation_count() { return count; }

void* counted_malloc(std::size_t size) {
  ++count;
  return std::malloc(size);
}

}  // namespace twincraft::test

void* operator new(std::size_t size) {
  if (void* memory = twincraft::test::counted_malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
