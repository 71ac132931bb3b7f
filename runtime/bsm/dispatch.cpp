// The kernel's instruction sets: which there are, and which this processor has.
// Tested by tests/runtime/kernel_test.cpp.
#include <array>

#include "runtime/bsm/kernel.h"

namespace twincraft::bsm {

#define TWINCRAFT_DECLARE_KERNEL(set)                           \
  namespace set {                                               \
  Kernel* new_kernel(const Plan* plan);                         \
  Kernel* new_batch_kernel(std::span<const Plan* const> plans); \
  std::size_t lanes_of_batch();                                 \
  }
TWINCRAFT_DECLARE_KERNEL(portable)
TWINCRAFT_DECLARE_KERNEL(avx2)
TWINCRAFT_DECLARE_KERNEL(avx512)
#undef TWINCRAFT_DECLARE_KERNEL

namespace {

struct Entries {
  std::string_view name;
  Kernel* (*new_kernel)(const Plan*);
  Kernel* (*new_batch_kernel)(std::span<const Plan* const>);
  std::size_t (*lanes_of_batch)();
};

constexpr std::array<Entries, 3> kSets{{
    {"x86-64", portable::new_kernel, portable::new_batch_kernel, portable::lanes_of_batch},
    {"AVX2", avx2::new_kernel, avx2::new_batch_kernel, avx2::lanes_of_batch},
    {"AVX-512", avx512::new_kernel, avx512::new_batch_kernel, avx512::lanes_of_batch},
}};

const Entries& entries(InstructionSet set) { return kSets[static_cast<std::size_t>(set)]; }

}  // namespace

std::string_view name_of(InstructionSet set) { return entries(set).name; }

InstructionSet best_instruction_set() {
  __builtin_cpu_init();
  const bool avx2 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  const bool avx512 = __builtin_cpu_supports("avx512f") != 0 &&
                      __builtin_cpu_supports("avx512dq") != 0 &&
                      __builtin_cpu_supports("avx512vl") != 0;
  if (!avx2) return InstructionSet::kPortable;
  return avx512 ? InstructionSet::kAvx512 : InstructionSet::kAvx2;
}

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(best_instruction_set()); ++i)
    sets.push_back(static_cast<InstructionSet>(i));
  return sets;
}

std::unique_ptr<Kernel> make_kernel(const Plan& plan, InstructionSet set) {
  return std::unique_ptr<Kernel>(entries(set).new_kernel(&plan));
}

std::size_t batch_lanes(InstructionSet set) { return entries(set).lanes_of_batch(); }

std::unique_ptr<Kernel> make_batch_kernel(std::span<const Plan* const> plans, InstructionSet set) {
  return std::unique_ptr<Kernel>(entries(set).new_batch_kernel(plans));
}

}  // namespace twincraft::bsm
